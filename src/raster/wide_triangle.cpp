#include "raster/wide_triangle.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace gnomon::raster {
namespace {

/// Returns the exact floor of a / b for b > 0. The function corrects a floating-point estimate, which is wrong by at
/// most one. It avoids integer divisions, which took a third of the drawing time of large triangles.
std::int64_t floorOfQuotient(std::int64_t a, std::int64_t b, double inverseOfB) {
    const auto estimate = static_cast<std::int64_t>(static_cast<double>(a) * inverseOfB);
    const std::int64_t rest = a - estimate * b;
    if (rest < 0) return estimate - 1;
    return rest >= b ? estimate + 1 : estimate;
}

/// Returns the edge function dx (Y - from.y) - dy (X - from.x) of the triangle edge from `from` to `to`. A pixel is
/// inside if the value is >= 0, or > 0 for an edge that is neither a left edge nor the lowest edge.
WideEdge wideEdge(const SnappedVertex& from, const SnappedVertex& to) {
    const std::int64_t dx = to.x - from.x;
    const std::int64_t dy = to.y - from.y;
    const bool ownsEdge = dy < 0 || (dy == 0 && dx > 0);
    WideEdge edge;
    edge.atZero = dy * from.x - dx * from.y - (ownsEdge ? 0 : 1);
    edge.perRow = dx * kSubpixels;
    edge.perPixel = -dy * kSubpixels;
    if (dy != 0) edge.inverse = 1 / static_cast<double>(std::abs(edge.perPixel));
    return edge;
}

/// The vector between two unsnapped corners of a triangle.
struct Side {
    double x;
    double y;

    Side(const SnappedVertex& from, const SnappedVertex& to)
        : x(to.x - from.x + (double{restOf(to.restX)} - restOf(from.restX))),
          y(to.y - from.y + (double{restOf(to.restY)} - restOf(from.restY))) {}
};

std::array<SnappedVertex, 3> withoutRests(std::array<SnappedVertex, 3> corners) {
    for (SnappedVertex& corner : corners)
        corner.restX = corner.restY = 0;
    return corners;
}

} // namespace

std::int64_t doubleArea(const std::array<SnappedVertex, 3>& corners) {
    const auto& [a, b, c] = corners;
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
}

WideTriangle wideTriangle(std::array<SnappedVertex, 3> corners) {
    std::int64_t area = doubleArea(corners);
    if (area < 0) {
        std::swap(corners[1], corners[2]);
        area = -area;
    }
    const auto& [a, b, c] = corners;
    const auto [minX, maxX] = std::minmax({a.x, b.x, c.x});
    const auto [minY, maxY] = std::minmax({a.y, b.y, c.y});
    const auto [minZ, maxZ] = std::minmax({a.z, b.z, c.z});
    const Side side1(a, b);
    const Side side2(a, c);
    const double unsnapped = side1.x * side2.y - side2.x * side1.y;
    // The unsnapped corners of a thin triangle give no reliable depth plane if most of its area comes from snapping.
    if (!(unsnapped > kMinTrueArea * static_cast<double>(area))) return wideTriangle(withoutRests(corners));
    const double dz1 = double{b.z} - a.z;
    const double dz2 = double{c.z} - a.z;
    const double scale = kSubpixels / unsnapped;
    WideTriangle wide;
    wide.corners = corners;
    wide.edges = {wideEdge(a, b), wideEdge(b, c), wideEdge(c, a)};
    wide.box = {
        (minX + kSubpixels - 1) >> kSubpixelBits,
        (minY + kSubpixels - 1) >> kSubpixelBits,
        (maxX >> kSubpixelBits) + 1,
        (maxY >> kSubpixelBits) + 1};
    wide.depthPerX = (dz1 * side2.y - dz2 * side1.y) * scale;
    wide.depthPerY = (dz2 * side1.x - dz1 * side2.x) * scale;
    wide.minDepth = std::clamp(minZ, 0.0F, 1.0F);
    wide.maxDepth = std::clamp(maxZ, 0.0F, 1.0F);
    return wide;
}

WideRows::WideRows(const WideTriangle& triangle, const PixelBox& tile)
    : y_(std::max(tile.y0, triangle.box.y0)),
      yEnd_(std::min(tile.y1, triangle.box.y1)),
      x0_(std::max(tile.x0, triangle.box.x0)),
      x1_(std::min(tile.x1, triangle.box.x1)) {
    for (const WideEdge& edge : triangle.edges)
        limitRows(edge);
    for (const WideEdge& edge : triangle.edges) {
        if (edge.perPixel == 0) continue;
        QuotientWalk walk;
        const std::int64_t at = edge.atZero + edge.perRow * y_;
        walk.divisor = std::abs(edge.perPixel);
        walk.quotient = floorOfQuotient(at, walk.divisor, edge.inverse);
        walk.rest = at - walk.quotient * walk.divisor;
        walk.quotientPerRow = floorOfQuotient(edge.perRow, walk.divisor, edge.inverse);
        walk.restPerRow = edge.perRow - walk.quotientPerRow * walk.divisor;
        if (edge.perPixel > 0)
            left_[leftCount_++] = walk;
        else
            right_[rightCount_++] = walk;
    }
    const SnappedVertex& a = triangle.corners[0];
    referenceX_ = a.x >> kSubpixelBits;
    depthPerX_ = static_cast<float>(triangle.depthPerX);
    depthAtReference_ = a.z + triangle.depthPerX * (referenceX_ - (a.x + double{restOf(a.restX)}) / kSubpixels);
    depthRow_ = (a.y + double{restOf(a.restY)}) / kSubpixels;
    depthPerY_ = triangle.depthPerY;
}

/// Limits the range of rows to the rows that have a pixel inside the edge. If no row of the tile has such a pixel, the
/// range becomes empty.
void WideRows::limitRows(const WideEdge& edge) {
    const auto best = [&](int y) { // max value of the edge function in the row
        return edge.atZero + edge.perRow * y + edge.perPixel * (edge.perPixel > 0 ? x1_ - 1 : x0_);
    };
    if (edge.perRow == 0) {
        if (best(y_) < 0) yEnd_ = y_;
        return;
    }
    const std::int64_t perRow = std::abs(edge.perRow);
    const double inverse = 1 / static_cast<double>(perRow);
    if (edge.perRow > 0 && best(y_) < 0) {
        const std::int64_t missing = -floorOfQuotient(best(y_), perRow, inverse);
        y_ = static_cast<int>(std::min<std::int64_t>(y_ + missing, yEnd_));
    } else if (edge.perRow < 0 && best(yEnd_ - 1) < 0) {
        const std::int64_t missing = -floorOfQuotient(best(yEnd_ - 1), perRow, inverse);
        yEnd_ = static_cast<int>(std::max<std::int64_t>(yEnd_ - missing, y_));
    }
}

} // namespace gnomon::raster
