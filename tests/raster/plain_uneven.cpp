#include "tests/raster/plain_uneven.h"

#include "raster/clip.h"
#include "raster/uneven/row_bands.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gnomon::raster {
namespace {

__extension__ using Wide = __int128;

/// A corner in the units of a band, snapped and as it was.
struct BandCorner {
    std::int64_t x, y;
    double trueX, trueY, z;
};

using BandCorners = std::array<BandCorner, 3>;

Wide twiceArea(const BandCorner& a, const BandCorner& b, std::int64_t x, std::int64_t y) {
    return Wide{b.x - a.x} * (y - a.y) - Wide{b.y - a.y} * (x - a.x);
}

bool isWithin(const BandCorner& a, const BandCorner& b, std::int64_t x, std::int64_t y) {
    const bool ownsEdge = b.y < a.y || (b.y == a.y && b.x > a.x);
    return twiceArea(a, b, x, y) >= (ownsEdge ? 0 : 1);
}

/// The plane of depth at (x, y): through the true corners unless snapping took most of the area.
double planeAt(const BandCorners& c, double x, double y) {
    const auto solved = [&](auto px, auto py, double area) {
        const double u = (px(c[1]) - px(c[0])) * (y - py(c[0])) - (py(c[1]) - py(c[0])) * (x - px(c[0]));
        const double v = (px(c[0]) - px(c[2])) * (y - py(c[2])) - (py(c[0]) - py(c[2])) * (x - px(c[2]));
        return c[0].z + (c[1].z - c[0].z) * (v / area) + (c[2].z - c[0].z) * (u / area);
    };
    const auto areaOf = [&](auto px, auto py) {
        return (px(c[1]) - px(c[0])) * (py(c[2]) - py(c[0])) - (px(c[2]) - px(c[0])) * (py(c[1]) - py(c[0]));
    };
    const auto trueX = [](const BandCorner& p) { return p.trueX; };
    const auto trueY = [](const BandCorner& p) { return p.trueY; };
    const auto snappedX = [](const BandCorner& p) { return static_cast<double>(p.x); };
    const auto snappedY = [](const BandCorner& p) { return static_cast<double>(p.y); };
    const double area = areaOf(trueX, trueY);
    const double snapped = areaOf(snappedX, snappedY);
    return area > 0.25 * snapped ? solved(trueX, trueY, area) : solved(snappedX, snappedY, snapped);
}

using SampleVisit = std::function<void(int, int, double, std::uint32_t)>;
using SnappedCorners = std::array<SnappedVertex, 3>;

/// The corners in the units of `band`, counter-clockwise.
BandCorners cornersIn(const RowBand& band, const SnappedCorners& corners) {
    BandCorners c{};
    for (std::size_t k = 0; k < 3; ++k) {
        const float units = (std::bit_cast<float>(corners[k].y) - band.base) * band.scale;
        const std::int64_t x = corners[k].x;
        c[k] = {x, std::llrint(units), static_cast<double>(x) + double{restOf(corners[k].restX)}, units, corners[k].z};
    }
    if (twiceArea(c[0], c[1], c[2].x, c[2].y) < 0) std::swap(c[1], c[2]);
    return c;
}

bool isInTriangle(const BandCorners& c, std::int64_t x, std::int64_t y) {
    return isWithin(c[0], c[1], x, y) && isWithin(c[1], c[2], x, y) && isWithin(c[2], c[0], x, y);
}

void visitBand(
    const View& view, const RowBand& band, const SnappedCorners& corners, std::uint32_t id, const SampleVisit& visit) {
    const BandCorners c = cornersIn(band, corners);
    if (twiceArea(c[0], c[1], c[2].x, c[2].y) == 0) return;
    const auto [minX, maxX] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [minZ, maxZ] = std::minmax({c[0].z, c[1].z, c[2].z});
    const auto x0 = static_cast<int>(std::max<std::int64_t>(view.viewport.x0, minX >> 8));
    const auto x1 = static_cast<int>(std::min<std::int64_t>(view.viewport.x1, (maxX >> 8) + 1));
    for (int y = band.first; y < band.end; ++y) {
        const float position = view.rowPositions[static_cast<std::size_t>(y - view.viewport.y0)];
        const std::int64_t up = std::llrint((position - band.base) * band.scale);
        for (int x = x0; x < x1; ++x) {
            const std::int64_t along = std::int64_t{256} * x;
            if (!isInTriangle(c, along, up)) continue;
            const double depth = planeAt(c, static_cast<double>(along), static_cast<double>(up));
            visit(x, y, std::clamp(std::clamp(depth, minZ, maxZ), 0.0, 1.0), id);
        }
    }
}

/// A triangle as it is clipped, in all bands.
void visitPolygon(
    const View& view, const RowBands& rows, const ClippedPolygon& polygon, std::uint32_t id, const SampleVisit& visit) {
    for (std::size_t k = 2; k < polygon.count; ++k)
        for (const RowBand& band : rows.bands())
            visitBand(view, band, {polygon.corners[0], polygon.corners[k - 1], polygon.corners[k]}, id, visit);
}

} // namespace

void visitUnevenSamples(
    std::span<const Cluster> clusters,
    const View& view,
    const std::function<void(int, int, double, std::uint32_t)>& visit) {
    RowBands rows;
    rows.reset(view.rowPositions, view.viewport.y0);
    const Projection pass = projection(view, false, &rows);
    for (const Cluster& cluster : clusters)
        for (std::uint32_t i = 0; i < cluster.triangles.size(); ++i) {
            std::array<ClipPosition, 3> corners;
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = clipPosition(
                    pass, cluster.positions + std::size_t{cluster.triangles[i][k]} * cluster.positionStride / 4);
            visitPolygon(view, rows, clipTriangle(pass, corners), cluster.firstTriangleId + i, visit);
        }
}

} // namespace gnomon::raster
