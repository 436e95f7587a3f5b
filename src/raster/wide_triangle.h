// Triangles of 64 pixels and more: which pixels of a row are inside, in 64-bit integers, and the plane of their depth.
#pragma once

#include "raster/projection.h"

#include <algorithm>
#include <array>
#include <cstdint>

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

/// Where a row leaves an edge, row by row: floor(value / divisor) for a value that grows by the same from row to row.
struct QuotientWalk {
    std::int64_t quotient = 0;
    std::int64_t rest = 0; // from 0 to divisor - 1
    std::int64_t quotientPerRow = 0;
    std::int64_t restPerRow = 0;
    std::int64_t divisor = 1;

    void step() {
        quotient += quotientPerRow;
        rest += restPerRow;
        const bool carries = rest >= divisor;
        quotient += carries ? 1 : 0;
        rest -= carries ? divisor : 0;
    }
};

/// The pixels of a row whose centres are inside, and depth: depthAtReference + depthPerX * (x - referenceX), held
/// between the triangle's extremes.
struct WideRow {
    int y = 0;
    int x0 = 0;
    int x1 = 0;
    float depthAtReference = 0;
};

/// The rows of a triangle in a tile, from the lowest up; some may be empty.
class WideRows {
public:
    WideRows(const WideTriangle& triangle, const PixelBox& tile);

    bool atEnd() const { return y_ >= yEnd_; }

    /// The row here; then goes on.
    WideRow next() {
        std::int64_t first = x0_;
        std::int64_t end = x1_;
        for (std::size_t i = 0; i < leftCount_; ++i) {
            first = std::max(first, -left_[i].quotient);
            left_[i].step();
        }
        for (std::size_t i = 0; i < rightCount_; ++i) {
            end = std::min(end, right_[i].quotient + 1);
            right_[i].step();
        }
        WideRow row;
        row.y = y_;
        row.x0 = static_cast<int>(std::min<std::int64_t>(first, x1_)); // an int even where nothing is inside
        row.x1 = static_cast<int>(std::max<std::int64_t>(end, x0_));
        row.depthAtReference = static_cast<float>(depthAtReference_ + depthPerY_ * (y_ - depthRow_));
        ++y_;
        return row;
    }

    int referenceX() const { return referenceX_; }

    float depthPerX() const { return depthPerX_; }

private:
    void limitRows(const WideEdge& edge);

    int y_ = 0;
    int yEnd_ = 0;
    int x0_ = 0;
    int x1_ = 0;
    std::array<QuotientWalk, 3> left_;
    std::array<QuotientWalk, 3> right_;
    std::size_t leftCount_ = 0;
    std::size_t rightCount_ = 0;
    int referenceX_ = 0;
    float depthPerX_ = 0;
    double depthAtReference_ = 0; // at the reference and depthRow_
    double depthRow_ = 0;
    double depthPerY_ = 0;
};

/// Twice the area is not zero. Corners may be in either order.
WideTriangle wideTriangle(std::array<SnappedVertex, 3> corners);

/// Twice the signed area in squared subpixels; positive is counter-clockwise with y up.
std::int64_t doubleArea(const std::array<SnappedVertex, 3>& corners);

} // namespace gnomon::raster
