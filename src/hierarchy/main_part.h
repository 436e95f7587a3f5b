// The main part of a model: its bounds without stray geometry. Default views frame this part.
#pragma once

#include "hierarchy/model.h"

namespace gnomon::hierarchy {

/// Stores `mainPart` (world space) as grid coordinates in the options of `summary`. Does nothing if `mainPart` contains
/// the model's bounds.
void setMainPart(ModelSummary& summary, const Box& mainPart);

/// Returns the main part in world space, clipped to the bounds of the model. Returns the bounds if the model stores no
/// main part or a damaged one.
Box mainPartOf(const ModelSummary& summary);

} // namespace gnomon::hierarchy
