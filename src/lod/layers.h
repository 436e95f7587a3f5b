// The depth complexity of an image: the number of clusters drawn on top of each other.
#pragma once

#include "lod/cut.h"

namespace gnomon::lod {

/// Returns the mean number of clusters of `image` per pixel, by their projected boxes. `image` is a draw list of
/// `query`. Each box is limited to the image. The function stops at `sufficientLayers`.
double imageLayers(const lod::CutQuery& query, const lod::DrawList& image, double sufficientLayers);

} // namespace gnomon::lod
