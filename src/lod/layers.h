// Estimates the depth complexity of an image: the mean number of drawn clusters that overlap at a pixel.
#pragma once

#include "lod/cut.h"

namespace gnomon::lod {

/// Returns the mean number of clusters that overlap at a pixel, estimated from the projected boxes of the clusters in
/// `image`. `image` is a list of drawn clusters of `query`. No box counts more pixels than the image has. The function
/// stops when the result reaches `sufficientLayers`.
double imageLayers(const lod::CutQuery& query, const lod::DrawList& image, double sufficientLayers);

} // namespace gnomon::lod
