// The description of a model as readable text and as JSON.
#pragma once

#include "hierarchy/model_file.h"
#include "hierarchy/up_guess.h"

#include <string>

namespace gnomon::hierarchy {

/// Returns the confidence in the up direction of the model. Guesses of older builds have the confidence Guess.
UpConfidence upConfidenceOf(const ModelSummary& summary);

/// Returns the up axis, the confidence and the reason: "z, sure by its shape".
std::string upText(const ModelSummary& summary);

/// Returns source, bounds, grid, file, levels and options of `file`, one per line. Unsafe characters in names are
/// escaped.
std::string modelText(const ModelFile& file);

/// Returns the same data as a JSON document, without the pages.
std::string modelJson(const ModelFile& file);

} // namespace gnomon::hierarchy
