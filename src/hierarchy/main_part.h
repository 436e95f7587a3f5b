// The main part of a model: all of it but strays. Views frame it.
#pragma once

#include "hierarchy/model.h"

namespace gnomon::hierarchy {

/// Stores `mainPart` (world space) in the options of `summary` as grid coordinates, unless it contains the bounds.
void setMainPart(ModelSummary& summary, const Box& mainPart);

/// Returns the box of the main part, world space: what `setMainPart` stored, without the rest of the bounds. Returns
/// the bounds of a model without strays, and of one that stores no main part or a damaged one.
Box mainPartOf(const ModelSummary& summary);

} // namespace gnomon::hierarchy
