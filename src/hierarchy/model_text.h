// What a model says of itself, as text for people and as JSON.
#pragma once

#include "hierarchy/model_file.h"
#include "hierarchy/up_guess.h"

#include <string>

namespace gnomon::hierarchy {

/// Returns how well it is known which way is up in the model. Guesses of older builds were never sure.
UpConfidence upConfidenceOf(const ModelSummary& summary);

/// Returns the axis that is up, how well that is known and why: "z, sure by its shape".
std::string upText(const ModelSummary& summary);

/// Source, bounds, grid, file, levels and options of `file`, line by line; what names in it hold is made printable.
std::string modelText(const ModelFile& file);

/// The same as one JSON document, without the pages.
std::string modelJson(const ModelFile& file);

} // namespace gnomon::hierarchy
