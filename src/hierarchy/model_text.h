// Describes a model as readable text and as JSON.
#pragma once

#include "hierarchy/model_file.h"
#include "hierarchy/up_guess.h"

#include <string>

namespace gnomon::hierarchy {

/// Returns the confidence in the up direction of the model. Guesses of older builds have the confidence Guess.
UpConfidence upConfidenceOf(const ModelSummary& summary);

/// Returns a text with the up axis, the confidence and the reason, for example "z, sure by its shape".
std::string upText(const ModelSummary& summary);

/// Returns a text with the source, bounds, grid, file, levels and options of a model, one per line. Unsafe characters
/// in names are escaped.
std::string modelText(const ModelFile& file);

/// Returns the data of modelText as a JSON document, which does not contain the pages.
std::string modelJson(const ModelFile& file);

} // namespace gnomon::hierarchy
