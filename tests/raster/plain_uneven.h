// Coverage with unevenly spaced rows, computed simply: each sample of the viewport against each edge.
#pragma once

#include "raster/raster.h"

#include <functional>

namespace gnomon::raster {

/// Calls `visit` for each sample (x, y) that a triangle covers, with the depth of the triangle's plane and the
/// triangle's id.
void visitUnevenSamples(
    std::span<const Cluster> clusters,
    const View& view,
    const std::function<void(int, int, double, std::uint32_t)>& visit);

} // namespace gnomon::raster
