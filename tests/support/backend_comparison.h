// Comparison of two backends after the same frame: pictures, depths and shadow maps.
#pragma once

#include "render/backend.h"

#include <cstddef>

namespace gnomon::render {

/// Differences, summed over frames.
struct BackendDifference {
    std::size_t pixels = 0;
    std::size_t coverage = 0;   // pixels covered by only one backend
    std::size_t color = 0;      // pixels with a channel that differs by more than 2 levels
    std::size_t lit = 0;        // difference of the numbers of lit pixels
    std::size_t texels = 0;     // texels of shadow maps, covered by both backends
    std::size_t texelCover = 0; // texels covered by only one backend
    std::size_t texelWrong = 0; // texels covered by both, with depths that differ by more than 1e-5
    // Texels whose difference also exceeds the depth steps to their neighbours (see below).
    std::size_t texelMoved = 0;
    double largestTexelDepth = 0; // largest of these differences

    void operator+=(const BackendDifference& other);
};

/// Compares the last frame of both backends. A GPU snaps vertices to a grid of 1/256 texel without a change of their
/// depths. Therefore a depth can differ by the change of the triangle's plane over this distance. `texelMoved` allows
/// 1/128 of the largest depth step to a neighbour.
BackendDifference difference(Backend& a, Backend& b);

} // namespace gnomon::render
