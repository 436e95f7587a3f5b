// A simple rasteriser without tiles, vector lanes or threads: pixel by pixel, with edges in 64 bits.
#pragma once

#include "raster/raster.h"

#include <functional>

namespace gnomon::raster {

/// Calls `visit(x, y, depth, triangle id)` for each pixel of the viewport that a triangle covers, including hidden
/// ones.
void visitPixels(
    std::span<const Cluster> clusters,
    const View& view,
    bool cutsDepth,
    const std::function<void(int, int, float, std::uint32_t)>& visit);

/// Computes the same depths and count as Rasterizer::drawDepth.
std::uint64_t plainDepth(std::span<const Cluster> clusters, const View& view, const DepthTarget& target);

/// Computes the same words as Rasterizer::drawVisibility.
void plainVisibility(std::span<const Cluster> clusters, const View& view, const VisibilityTarget& target);

} // namespace gnomon::raster
