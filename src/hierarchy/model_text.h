// What a model says of itself, as text for people.
#pragma once

#include "hierarchy/model_file.h"

#include <string>

namespace gnomon::hierarchy {

/// Source, bounds, grid, file, levels and options of `file`, line by line; what names in it hold is made printable.
std::string modelText(const ModelFile& file);

} // namespace gnomon::hierarchy
