// Triangles with a bounding box of 64 pixels or more: computes the covered pixels of a row with 64-bit integers, and
// the depth plane.
#pragma once

#include "raster/projection.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace gnomon::raster {

/// Size limit of a narrow triangle's bounding box, in subpixels, exclusive. Below this limit, edge functions fit an
/// int32.
constexpr std::int32_t kNarrowExtent = 64 * kSubpixels;

/// An edge function of a triangle. Pixel (x, y) is inside if atZero + perRow * y + perPixel * x >= 0.
struct WideEdge {
    std::int64_t atZero = 0;
    std::int64_t perRow = 0;
    std::int64_t perPixel = 0;
    double inverse = 0; // 1 / |perPixel| if perPixel is not 0
};

/// A triangle after triangle setup, with counter-clockwise corners (y up), edge functions and a depth plane.
struct WideTriangle {
    std::array<SnappedVertex, 3> corners;
    std::array<WideEdge, 3> edges;
    PixelBox box;         // pixel centres in the bounding box of the corners
    double depthPerX = 0; // change of depth per pixel
    double depthPerY = 0;
    float minDepth = 0; // smallest depth of the corners, clamped to [0, 1]
    float maxDepth = 0;
};

/// A quotient floor(value / divisor) whose `value` grows by a constant per row. The rasteriser uses such quotients to
/// find the column in which each row crosses a triangle edge. The update from row to row needs no division.
struct QuotientWalk {
    std::int64_t quotient = 0;
    std::int64_t rest = 0; // remainder, in [0, divisor - 1]
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

/// The pixels x0 to x1 - 1 of a row that a triangle covers. The depth is depthAtReference + depthPerX * (x -
/// referenceX), clamped to the depth range of the corners.
struct WideRow {
    int y = 0;
    int x0 = 0;
    int x1 = 0;
    float depthAtReference = 0;
};

/// Iterates over the rows of a triangle in a tile, from bottom to top. Some rows can be empty.
class WideRows {
public:
    WideRows(const WideTriangle& triangle, const PixelBox& tile);

    bool atEnd() const { return y_ >= yEnd_; }

    /// Returns the covered pixels of the current row, and advances to the next row.
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
        row.x0 = static_cast<int>(std::min<std::int64_t>(first, x1_)); // fits an int even if the row is empty
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
    double depthAtReference_ = 0; // depth at the reference column in row depthRow_
    double depthRow_ = 0;
    double depthPerY_ = 0;
};

/// Computes the edge functions and the depth plane of a triangle. `corners` can have either order. Twice the triangle's
/// area must not be 0.
WideTriangle wideTriangle(std::array<SnappedVertex, 3> corners);

/// Returns twice the signed area of a triangle, in squared subpixels. Counter-clockwise triangles (y up) have a
/// positive area.
std::int64_t doubleArea(const std::array<SnappedVertex, 3>& corners);

} // namespace gnomon::raster
