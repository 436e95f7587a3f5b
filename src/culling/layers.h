// The depth complexity of an image: the number of clusters drawn on top of each other.
#pragma once

#include "selection/cut.h"

namespace gnomon::culling {

/// Returns the mean number of clusters of `image` per pixel, by their projected boxes. `image` is a draw list of
/// `query`. Each box is limited to the image. The function stops at `enough`.
double imageLayers(const selection::CutQuery& query, const selection::DrawList& image, double enough);

} // namespace gnomon::culling
