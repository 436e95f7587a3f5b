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

/// Depth of triangles under 64 pixels: over the edge functions in floats.
float narrowDepth(const Corners& c, std::int64_t area, std::int64_t e1, std::int64_t e2) {
    const float inverse = 1.0F / static_cast<float>(area);
    const float perE1 = (c[1].z - c[0].z) * inverse;
    const float perE2 = (c[2].z - c[0].z) * inverse;
    return (c[0].z + static_cast<float>(e1) * perE1) + static_cast<float>(e2) * perE2;
}

/// Depth of the others: its plane in doubles, along a row in floats.
float wideDepth(const Corners& c, std::int64_t area, int x, int y) {
    const double dz1 = double{c[1].z} - c[0].z;
    const double dz2 = double{c[2].z} - c[0].z;
    const double scale = 256 / static_cast<double>(area);
    const double perX = (dz1 * (c[2].y - c[0].y) - dz2 * (c[1].y - c[0].y)) * scale;
    const double perY = (dz2 * (c[1].x - c[0].x) - dz1 * (c[2].x - c[0].x)) * scale;
    const int reference = c[0].x >> 8;
    const auto atReference =
        static_cast<float>(c[0].z + perX * (reference - c[0].x / 256.0) + perY * (y - c[0].y / 256.0));
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
            const float depth = isNarrow ? narrowDepth(c, area, e1, e2) : wideDepth(c, area, x, y);
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

void plainDepth(std::span<const Cluster> clusters, const View& view, const DepthTarget& target) {
    const auto at = [&](int x, int y) -> float& {
        return target
            .depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(target.width) + static_cast<std::size_t>(x)];
    };
    for (int y = view.viewport.y0; y < view.viewport.y1; ++y)
        for (int x = view.viewport.x0; x < view.viewport.x1; ++x)
            at(x, y) = 1;
    visitPixels(clusters, view, false, [&](int x, int y, float depth, std::uint32_t /*id*/) {
        at(x, y) = std::min(at(x, y), depth);
    });
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
