// The rasteriser once more, without tiles, lanes or threads: one pixel after another, edges in 64 bits.
#pragma once

#include "raster/raster.h"

#include <functional>

namespace gnomon::raster {

/// Calls `visit(x, y, depth, triangle id)` for every pixel of the viewport that a triangle covers, hidden or not.
void visitPixels(
    std::span<const Cluster> clusters,
    const View& view,
    bool cutsDepth,
    const std::function<void(int, int, float, std::uint32_t)>& visit);

/// What Rasterizer::drawDepth leaves and answers, in plain code.
std::uint64_t plainDepth(std::span<const Cluster> clusters, const View& view, const DepthTarget& target);

/// What Rasterizer::drawVisibility leaves, in plain code.
void plainVisibility(std::span<const Cluster> clusters, const View& view, const VisibilityTarget& target);

} // namespace gnomon::raster
