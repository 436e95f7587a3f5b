#include "tests/raster/plain_raster.h"

#include "raster/clip.h"

#include <algorithm>
#include <cmath>

namespace gnomon::raster {
namespace {

using Visit = std::function<void(int, int, float, std::uint32_t)>;
using Corners = std::array<SnappedVertex, 3>;

constexpr std::int64_t kNarrow = std::int64_t{64} * 256;

std::int64_t signedDoubleArea(const SnappedVertex& a, const SnappedVertex& b, std::int64_t x, std::int64_t y) {
    return std::int64_t{b.x - a.x} * (y - a.y) - std::int64_t{b.y - a.y} * (x - a.x);
}

/// Less one where the edge neither rises on the left nor lies below.
std::int64_t edge(const SnappedVertex& a, const SnappedVertex& b, std::int64_t x, std::int64_t y) {
    const bool ownsEdge = b.y < a.y || (b.y == a.y && b.x > a.x);
    return signedDoubleArea(a, b, x, y) - (ownsEdge ? 0 : 1);
}

/// A corner less corner 0: snapped, and what snapping cut off.
template <class Real>
struct Side {
    Real x, y, restX, restY;

    Side(const SnappedVertex& from, const SnappedVertex& to)
        : x(static_cast<Real>(to.x - from.x)),
          y(static_cast<Real>(to.y - from.y)),
          restX(Real{restOf(to.restX)} - Real{restOf(from.restX)}),
          restY(Real{restOf(to.restY)} - Real{restOf(from.restY)}) {}
};

/// Depth of triangles under 64 pixels: its plane in floats, from the pixel of corner 0.
float narrowDepth(Corners c, std::int64_t area, int x, int y) {
    const Side<float> u(c[0], c[1]);
    const Side<float> v(c[0], c[2]);
    const float change = (u.x * v.restY - v.x * u.restY) + (u.restX * (v.y + v.restY) - v.restX * (u.y + u.restY));
    const auto snappedArea = static_cast<float>(area);
    if (!(snappedArea + change > snappedArea * 0.25F)) {
        for (SnappedVertex& corner : c)
            corner.restX = corner.restY = 0;
        return narrowDepth(c, area, x, y);
    }
    const float inverse = 1.0F / (snappedArea + change);
    const float dz1 = c[1].z - c[0].z;
    const float dz2 = c[2].z - c[0].z;
    const float perX = (dz1 * (v.y + v.restY) - dz2 * (u.y + u.restY)) * inverse;
    const float perY = (dz2 * (u.x + u.restX) - dz1 * (v.x + v.restX)) * inverse;
    const int referenceX = c[0].x >> 8;
    const int referenceY = c[0].y >> 8;
    const float atReference = (c[0].z + perX * (static_cast<float>(referenceX * 256 - c[0].x) - restOf(c[0].restX))) +
                              perY * (static_cast<float>(referenceY * 256 - c[0].y) - restOf(c[0].restY));
    return (atReference + perY * 256 * static_cast<float>(y - referenceY)) +
           perX * 256 * static_cast<float>(x - referenceX);
}

/// Depth of the others: its plane in doubles, along a row in floats.
float wideDepth(Corners c, std::int64_t area, int x, int y) {
    const Side<double> u(c[0], c[1]);
    const Side<double> v(c[0], c[2]);
    const double unsnapped = (u.x + u.restX) * (v.y + v.restY) - (v.x + v.restX) * (u.y + u.restY);
    if (!(unsnapped > 0.25 * static_cast<double>(area))) {
        for (SnappedVertex& corner : c)
            corner.restX = corner.restY = 0;
        return wideDepth(c, area, x, y);
    }
    const double dz1 = double{c[1].z} - c[0].z;
    const double dz2 = double{c[2].z} - c[0].z;
    const double scale = 256 / unsnapped;
    const double perX = (dz1 * (v.y + v.restY) - dz2 * (u.y + u.restY)) * scale;
    const double perY = (dz2 * (u.x + u.restX) - dz1 * (v.x + v.restX)) * scale;
    const int reference = c[0].x >> 8;
    const auto atReference = static_cast<float>(
        c[0].z + perX * (reference - (c[0].x + double{restOf(c[0].restX)}) / 256) +
        perY * (y - (c[0].y + double{restOf(c[0].restY)}) / 256));
    return atReference + static_cast<float>(perX) * static_cast<float>(x - reference);
}

void visitTriangle(Corners c, const PixelBox& viewport, std::uint32_t id, const Visit& visit) {
    std::int64_t area = signedDoubleArea(c[0], c[1], c[2].x, c[2].y);
    if (area == 0) return;
    if (area < 0) {
        std::swap(c[1], c[2]);
        area = -area;
    }
    const auto [minX, maxX] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [minY, maxY] = std::minmax({c[0].y, c[1].y, c[2].y});
    const auto [minZ, maxZ] = std::minmax({c[0].z, c[1].z, c[2].z});
    const bool isNarrow = maxX - minX < kNarrow && maxY - minY < kNarrow;
    constexpr std::int64_t kPixel = 256;
    for (int y = std::max(viewport.y0, minY >> 8); y < viewport.y1 && y * 256 <= maxY; ++y)
        for (int x = std::max(viewport.x0, minX >> 8); x < viewport.x1 && x * 256 <= maxX; ++x) {
            const std::int64_t e0 = edge(c[1], c[2], x * kPixel, y * kPixel);
            const std::int64_t e1 = edge(c[2], c[0], x * kPixel, y * kPixel);
            const std::int64_t e2 = edge(c[0], c[1], x * kPixel, y * kPixel);
            if (e0 < 0 || e1 < 0 || e2 < 0) continue;
            const float depth = isNarrow ? narrowDepth(c, area, x, y) : wideDepth(c, area, x, y);
            visit(x, y, std::clamp(std::clamp(depth, minZ, maxZ), 0.0F, 1.0F), id);
        }
}

} // namespace

void visitPixels(std::span<const Cluster> clusters, const View& view, bool cutsDepth, const Visit& visit) {
    const Projection pass = projection(view, cutsDepth);
    for (const Cluster& cluster : clusters)
        for (std::uint32_t i = 0; i < cluster.triangles.size(); ++i) {
            std::array<ClipPosition, 3> corners;
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = clipPosition(
                    pass, cluster.positions + std::size_t{cluster.triangles[i][k]} * cluster.positionStride / 4);
            const ClippedPolygon polygon = clipTriangle(pass, corners);
            for (std::size_t k = 2; k < polygon.count; ++k)
                visitTriangle(
                    {polygon.corners[0], polygon.corners[k - 1], polygon.corners[k]},
                    view.viewport,
                    cluster.firstTriangleId + i,
                    visit);
        }
}

std::uint64_t plainDepth(std::span<const Cluster> clusters, const View& view, const DepthTarget& target) {
    const auto at = [&](int x, int y) -> float& {
        return target
            .depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(target.width) + static_cast<std::size_t>(x)];
    };
    for (int y = view.viewport.y0; y < view.viewport.y1; ++y)
        for (int x = view.viewport.x0; x < view.viewport.x1; ++x)
            at(x, y) = 1;
    std::uint64_t fragments = 0;
    visitPixels(clusters, view, false, [&](int x, int y, float depth, std::uint32_t /*id*/) {
        at(x, y) = std::min(at(x, y), depth);
        ++fragments;
    });
    return fragments;
}

void plainVisibility(std::span<const Cluster> clusters, const View& view, const VisibilityTarget& target) {
    const auto at = [&](int x, int y) -> std::uint64_t& {
        return target
            .words[static_cast<std::size_t>(y) * static_cast<std::size_t>(target.width) + static_cast<std::size_t>(x)];
    };
    for (int y = view.viewport.y0; y < view.viewport.y1; ++y)
        for (int x = view.viewport.x0; x < view.viewport.x1; ++x)
            at(x, y) = 0;
    visitPixels(clusters, view, true, [&](int x, int y, float depth, std::uint32_t id) {
        at(x, y) = std::max(at(x, y), visibilityWord(depth, id));
    });
}

} // namespace gnomon::raster
