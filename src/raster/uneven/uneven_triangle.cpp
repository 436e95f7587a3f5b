#include "raster/uneven/uneven_triangle.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace gnomon::raster {
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
        edges_[i] = {dx, dy, dy * from.x - dx * from.y - (ownsEdge ? 0 : 1), perPixel, inverse};
    }
    const auto& [a, b, c] = corners_;
    minDepth_ = std::clamp(std::min({a.z, b.z, c.z}), 0.0F, 1.0F);
    maxDepth_ = std::clamp(std::max({a.z, b.z, c.z}), 0.0F, 1.0F);
    const double x1 = b.x - a.x + (b.restX - a.restX);
    const double x2 = c.x - a.x + (c.restX - a.restX);
    const double unsnapped = x1 * (c.unsnappedY - a.unsnappedY) - x2 * (b.unsnappedY - a.unsnappedY);
    // The unsnapped corners of a thin triangle give no reliable depth plane if most of its area comes from snapping.
    setPlane(unsnapped > kMinTrueArea * static_cast<double>(area()));
}

/// Computes the depth plane from the unsnapped corners if `isTrue`, otherwise from the snapped corners.
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
        return edge.dx * y - edge.dy * x + edge.atOrigin >= 0;
    });
}

} // namespace gnomon::raster
