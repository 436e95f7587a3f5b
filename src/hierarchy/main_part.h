// The main part of a model: its bounds without stray geometry far away. Default views show this part.
#pragma once

#include "hierarchy/model.h"

namespace gnomon::hierarchy {

/// Stores `mainPart`, the bounds of the model without stray geometry (world space), in `summary` as grid coordinates.
/// Does nothing if `mainPart` contains the model's bounds.
void setMainPart(ModelSummary& summary, const Box& mainPart);

/// Returns the bounds of a model without stray geometry, in world space. They are clipped to the full bounds. Returns
/// the full bounds if the model stores no main part or a damaged one.
Box mainPartOf(const ModelSummary& summary);

} // namespace gnomon::hierarchy
