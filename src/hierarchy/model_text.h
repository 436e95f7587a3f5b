// What a model says of itself, as text for people and as JSON.
#pragma once

#include "hierarchy/model_file.h"

#include <string>

namespace gnomon::hierarchy {

/// Source, bounds, grid, file, levels and options of `file`, line by line; what names in it hold is made printable.
std::string modelText(const ModelFile& file);

/// The same as one JSON document, without the pages.
std::string modelJson(const ModelFile& file);

} // namespace gnomon::hierarchy
