// Triangles of 64 pixels and more: which pixels of a row are inside, in 64-bit integers, and the plane of their depth.
#pragma once

#include "raster/projection.h"

namespace gnomon::raster {

/// Triangles less wide and high than this many subpixels have edge functions that fit an int32.
constexpr std::int32_t kNarrowExtent = 64 * kSubpixels;

/// An edge's side of the plane: inside where atZero + perRow * y + perPixel * x >= 0, for pixels (x, y).
struct WideEdge {
    std::int64_t atZero = 0;
    std::int64_t perRow = 0;
    std::int64_t perPixel = 0;
    double inverse = 0; // 1 / |perPixel|, where that is not 0
};

/// A triangle turned counter-clockwise (y up), with its plane of depth.
struct WideTriangle {
    std::array<SnappedVertex, 3> corners;
    std::array<WideEdge, 3> edges;
    PixelBox box;         // pixel centres between the corners' extremes
    double depthPerX = 0; // per pixel
    double depthPerY = 0;
    float leastDepth = 0; // of the corners, within 0 to 1
    float largestDepth = 0;
};

/// A span of a row, and its depth: firstDepth + depthPerX * (x - referenceX), held between the triangle's extremes.
struct WideRow {
    int x0 = 0;
    int x1 = 0;
    int referenceX = 0;
    float depthAtReference = 0;
    float depthPerX = 0;
};

/// Twice the area is not zero. Corners may be in either order.
WideTriangle wideTriangle(std::array<SnappedVertex, 3> corners);

/// The pixels of row `y` between `x0` and `x1` whose centres are inside.
WideRow wideRow(const WideTriangle& triangle, int y, int x0, int x1);

/// Twice the signed area in squared subpixels; positive is counter-clockwise with y up.
std::int64_t doubleArea(const std::array<SnappedVertex, 3>& corners);

} // namespace gnomon::raster
