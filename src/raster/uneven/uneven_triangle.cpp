#include "raster/uneven/uneven_triangle.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace gnomon::raster {
namespace {

/// The floor of a / b, b above 0 with that `inverse`; at least kFarSamples from 0 where the quotient is. An estimate
/// that is off by one at most, and its correction.
std::int64_t flooredSamples(std::int64_t a, std::int64_t b, double inverse) {
    const double quotient = static_cast<double>(a) * inverse;
    if (std::abs(quotient) >= kFarSamples) return static_cast<std::int64_t>(std::copysign(kFarSamples, quotient));
    const auto estimate = static_cast<std::int64_t>(quotient);
    const std::int64_t rest = a - estimate * b;
    if (rest < 0) return estimate - 1;
    return rest >= b ? estimate + 1 : estimate;
}

} // namespace

UnevenVertex unevenVertex(const RowBand& band, const SnappedVertex& vertex) {
    const float units = band.units(std::bit_cast<float>(vertex.y));
    return {vertex.x, std::llrint(units), restOf(vertex.restX), units, vertex.z};
}

UnevenTriangle::UnevenTriangle(std::array<UnevenVertex, 3> corners) : corners_(corners) {
    const auto area = [&] {
        const auto& [a, b, c] = corners_;
        return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
    };
    hasArea_ = area() != 0;
    if (area() < 0) std::swap(corners_[1], corners_[2]);
    for (std::size_t i = 0; i < 3; ++i) {
        const UnevenVertex& from = corners_[i];
        const UnevenVertex& to = corners_[(i + 1) % 3];
        const std::int64_t dx = to.x - from.x;
        const std::int64_t dy = to.y - from.y;
        const bool ownsEdge = dy < 0 || (dy == 0 && dx > 0);
        const std::int64_t perPixel = -dy * kSubpixels;
        const double inverse = perPixel == 0 ? 0 : 1 / std::abs(static_cast<double>(perPixel));
        edges_[i] = {from.x, from.y, dx, dy, ownsEdge ? 0 : 1, perPixel, inverse};
    }
    const auto& [a, b, c] = corners_;
    leastDepth_ = std::clamp(std::min({a.z, b.z, c.z}), 0.0F, 1.0F);
    largestDepth_ = std::clamp(std::max({a.z, b.z, c.z}), 0.0F, 1.0F);
    const double x1 = b.x - a.x + (b.restX - a.restX);
    const double x2 = c.x - a.x + (c.restX - a.restX);
    const double unsnapped = x1 * (c.unsnappedY - a.unsnappedY) - x2 * (b.unsnappedY - a.unsnappedY);
    // A sliver that snapping made: without it there would be no plane.
    setPlane(unsnapped > kLeastTrueArea * static_cast<double>(area()));
}

/// The plane through the corners as they were before snapping, or as they are.
void UnevenTriangle::setPlane(bool isTrue) {
    const auto x = [&](const UnevenVertex& vertex) { return vertex.x + (isTrue ? vertex.restX : 0); };
    const auto y = [&](const UnevenVertex& vertex) {
        return isTrue ? vertex.unsnappedY : static_cast<double>(vertex.y);
    };
    const auto& [a, b, c] = corners_;
    const double x1 = x(b) - x(a);
    const double x2 = x(c) - x(a);
    const double y1 = y(b) - y(a);
    const double y2 = y(c) - y(a);
    const double dz1 = double{b.z} - a.z;
    const double dz2 = double{c.z} - a.z;
    const double area = x1 * y2 - x2 * y1;
    depthPerX_ = (dz1 * y2 - dz2 * y1) / area * kSubpixels;
    depthPerY_ = (dz2 * x1 - dz1 * x2) / area;
    startX_ = x(a);
    startY_ = y(a);
}

bool UnevenTriangle::mayTouch(const RowBand& band, const PixelBox& box) const {
    const std::int64_t low = band.rows[static_cast<std::size_t>(box.y0 - band.first)];
    const std::int64_t high = band.rows[static_cast<std::size_t>(box.y1 - 1 - band.first)];
    return std::all_of(edges_.begin(), edges_.end(), [&](const Edge& edge) {
        const std::int64_t y = edge.dx > 0 ? high : low;
        const std::int64_t x = std::int64_t{edge.perPixel > 0 ? box.x1 - 1 : box.x0} * kSubpixels;
        return edge.dx * (y - edge.y) - edge.dy * (x - edge.x) >= edge.own;
    });
}

WideRow UnevenTriangle::row(const RowBand& band, int y, int x0, int x1) const {
    const std::int64_t units = band.rows[static_cast<std::size_t>(y - band.first)];
    std::int64_t first = x0;
    std::int64_t end = x1;
    for (const Edge& edge : edges_) {
        // At the column X this is less by dy (X - x), 256 dy for each.
        const std::int64_t at = edge.dx * (units - edge.y) + edge.dy * edge.x - edge.own;
        if (edge.perPixel > 0)
            first = std::max(first, -flooredSamples(at, edge.perPixel, edge.inverse));
        else if (edge.perPixel < 0)
            end = std::min(end, flooredSamples(at, -edge.perPixel, edge.inverse) + 1);
        else if (at < 0)
            end = x0;
    }
    WideRow row;
    row.y = y;
    row.x0 = static_cast<int>(std::min<std::int64_t>(first, x1));
    row.x1 = static_cast<int>(std::max<std::int64_t>(end, x0));
    row.depthAtReference = static_cast<float>(
        corners_[0].z + depthPerX_ * (referenceX() - startX_ / kSubpixels) +
        depthPerY_ * (static_cast<double>(units) - startY_));
    return row;
}

} // namespace gnomon::raster
