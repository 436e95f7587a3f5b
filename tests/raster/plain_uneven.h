// Coverage on rows that lie unevenly, the obvious way: every sample of the viewport against every edge.
#pragma once

#include "raster/raster.h"

#include <functional>

namespace gnomon::raster {

/// Calls `visit` with each sample (x, y) that a triangle covers, the depth of the plane through its corners there, and
/// the triangle's name.
void visitUnevenSamples(
    std::span<const Cluster> clusters,
    const View& view,
    const std::function<void(int, int, double, std::uint32_t)>& visit);

} // namespace gnomon::raster
