// The main part of a model: the model without stray geometry. Default views frame this part.
#pragma once

#include "hierarchy/model.h"

namespace gnomon::hierarchy {

/// Stores `mainPart` (world space) as grid coordinates in the options of `summary`. Does nothing if it contains the
/// bounds.
void setMainPart(ModelSummary& summary, const Box& mainPart);

/// Returns the box of the main part in world space, clipped to the bounds. Returns the bounds if the model stores no
/// main part or a damaged one.
Box mainPartOf(const ModelSummary& summary);

} // namespace gnomon::hierarchy
