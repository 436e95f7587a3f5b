// Describes a model as readable text and as JSON, for `gnomon info`.
#pragma once

#include "hierarchy/model_file.h"
#include "hierarchy/up_guess.h"

#include <string>

namespace gnomon::hierarchy {

/// Returns how reliable the up direction of the model is. Guesses of older builds have the confidence Guess.
UpConfidence upConfidenceOf(const ModelSummary& summary);

/// Returns a text with the up axis of a model, the confidence and the reason, for example "z, sure by its shape".
std::string upText(const ModelSummary& summary);

/// Returns a text that describes a model, with one property per line: source, bounds, grid, file, levels and options.
/// Unsafe characters in names are escaped.
std::string modelText(const ModelFile& file);

/// Returns the description of a model as a JSON document, with the same data as modelText. It does not contain the
/// pages.
std::string modelJson(const ModelFile& file);

} // namespace gnomon::hierarchy
