// Computes a lower bound of the view depth of visible geometry. The bound is valid for each level of detail.
#pragma once

#include "lod/cut.h"

namespace gnomon::lod {

/// Returns a lower bound of the view depth of visible geometry: the smallest depth of the finest level's page boxes
/// that intersect the view. Returns 0 if the eye is inside such a box, and infinity if no box is in view. A surface of
/// a coarser level can be nearer by its error, which is small compared with the depth. A margin of 5% in depth and in
/// the view angles covers errors up to 5% of the image height.
double nearestDepth(const PageTrees& trees, const DetailView& view);

} // namespace gnomon::lod
