// How many layers of clusters an image draws one behind the other.
#pragma once

#include "selection/cut.h"

namespace gnomon::culling {

/// How many clusters of `image`, a draw list of `query`, lie over a pixel on average, by their boxes as the eye sees
/// them, each over the whole image at most. Stops counting at `enough`.
double imageLayers(const selection::CutQuery& query, const selection::DrawList& image, double enough);

} // namespace gnomon::culling
