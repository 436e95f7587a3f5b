#include "raster/tile_kernel.h"
#include "raster/uneven/row_bands.h"
#include "raster/uneven/uneven_triangle.h"

#include <algorithm>
#include <cmath>

// The order matters: foreach_target.h includes this file again for each instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/uneven/uneven_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "raster/sorted_triangles-inl.h"
#include "raster/stored_lanes-inl.h"
#include "raster/tile_target-inl.h"
#include "raster/triangle_lanes-inl.h"
#include "raster/uneven/band_vertices-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {

/// Returns a mask of the SIMD lanes whose triangles are narrow, so that their edge functions fit an int32.
HWY_INLINE IntMask isNarrow(const UnevenSource& source, Ints corners) {
    const PointLanes a = source.pointAt(cornerIndex<0>(corners));
    const PointLanes b = source.pointAt(cornerIndex<1>(corners));
    const PointLanes c = source.pointAt(cornerIndex<2>(corners));
    const auto narrow = hn::Set(kInts, kNarrowExtent);
    return hn::And(
        hn::Lt(hn::Sub(maxOf(a.x, b.x, c.x), minOf(a.x, b.x, c.x)), narrow),
        hn::Lt(hn::Sub(maxOf(a.y, b.y, c.y), minOf(a.y, b.y, c.y)), narrow));
}

/// Sorts the triangles of a cluster into size classes by the number of pixel centres that they may cover. Skips
/// triangles that cannot cover a pixel centre of the tile.
HWY_INLINE void sortUneven(
    const SnappedCluster& cluster,
    const BandVertices& vertices,
    const UnevenSource& source,
    const BandLanes& rows,
    SortedCluster& sorted) {
    PackedTriangles packed; // NOLINT(cppcoreguidelines-pro-type-member-init): packTriangles fills it
    packTriangles(cluster.triangles, packed);
    sorted.clear();
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    const auto round = hn::Set(kInts, kSubpixels - 1);
    const auto lastColumn = hn::Set(kInts, rows.tile->width() - 1);
    const auto firstOfTile = hn::Set(kInts, rows.tile->y0 - rows.band->first);
    const auto endOfTile = hn::Set(kInts, rows.tile->y1 - rows.band->first);
    using Place = VertexPlace;
    for (std::uint32_t first = 0; first < cluster.triangles.size(); first += lanes) {
        const auto corners = hn::BitCast(kInts, hn::LoadU(kUints, packed.data() + first));
        const auto a = hn::GatherIndex(kInts, vertices.places.data(), cornerIndex<0>(corners));
        const auto b = hn::GatherIndex(kInts, vertices.places.data(), cornerIndex<1>(corners));
        const auto c = hn::GatherIndex(kInts, vertices.places.data(), cornerIndex<2>(corners));
        // The range of pixels in the bounding box of each triangle. Rows are counted from the first row of the band.
        const auto minX = minOf(Place::x(a), Place::x(b), Place::x(c));
        const auto maxX = maxOf(Place::x(a), Place::x(b), Place::x(c));
        const auto firstX = hn::ShiftRight<kSubpixelBits>(hn::Add(minX, round));
        const auto lastX = hn::Min(hn::ShiftRight<kSubpixelBits>(maxX), lastColumn);
        const auto firstRow = hn::Max(minOf(Place::row(a), Place::row(b), Place::row(c)), firstOfTile);
        const auto endRow = hn::Min(maxOf(Place::rowAbove(a), Place::rowAbove(b), Place::rowAbove(c)), endOfTile);
        const auto columns = hn::Sub(lastX, hn::Max(firstX, hn::Zero(kInts)));
        const auto rowCount = hn::Sub(hn::Sub(endRow, firstRow), hn::Set(kInts, 1));
        const auto drawn = hn::Gt(hn::Min(columns, rowCount), hn::Set(kInts, -1));
        if (hn::AllFalse(kInts, drawn)) continue;
        const auto isOfNarrow = vertices.isNarrow ? drawn : hn::And(drawn, isNarrow(source, corners));
        const auto reach = hn::Max(columns, rowCount);
        const auto isTiny = hn::And(isOfNarrow, hn::Lt(reach, hn::Set(kInts, 2)));
        const auto isSmall = hn::And(isOfNarrow, hn::Lt(reach, hn::Set(kInts, 4)));
        sorted.tiny.add(corners, isTiny);
        sorted.small.add(corners, hn::AndNot(isTiny, isSmall));
        const auto larger = hn::AndNot(isSmall, drawn);
        if (hn::AllFalse(kInts, larger)) continue;
        sorted.narrow.add(corners, hn::And(larger, isOfNarrow));
        sorted.wide.add(corners, hn::AndNot(isOfNarrow, larger));
    }
    sorted.pad();
}

/// The results of triangle setup in a logarithmic map, with one triangle per SIMD lane: the first pixels, the units of
/// the first row and of the highest corner, and the reference row of the depth plane.
struct UnevenLanes {
    TriangleLanes t; // rows are counted from the band's first row; lastY is the tile's last row
    Ints firstUnits;
    Ints highestUnits;
    Ints referenceUnits;
};

/// Returns the distance from the depth plane's reference row to the height `units`, in pixels of 256 units.
HWY_INLINE Floats fromReference(Ints units, Ints referenceUnits) {
    const auto pixels = hn::Set(kFloats, 1.0F / kSubpixels);
    return hn::Mul(hn::ConvertTo(kFloats, hn::Sub(units, referenceUnits)), pixels);
}

/// Computes triangle setup for one narrow triangle per SIMD lane and returns the result. The corners are then
/// counter-clockwise.
HWY_INLINE UnevenLanes
unevenLanes(const SnappedCluster& cluster, const UnevenSource& source, Ints packed, const BandLanes& rows) {
    const auto i0 = cornerIndex<0>(packed);
    auto i1 = cornerIndex<1>(packed);
    auto i2 = cornerIndex<2>(packed);
    const PointLanes a = source.pointAt(i0);
    PointLanes b = source.pointAt(i1);
    PointLanes c = source.pointAt(i2);
    const auto area = turnedArea(a, b, c, i1, i2);

    const PixelBox& tile = *rows.tile;
    const int above = rows.band->first;
    UnevenLanes lanes;
    TriangleLanes& t = lanes.t;
    t.hasArea = hn::Gt(area, hn::Zero(kInts));
    const auto round = hn::Set(kInts, kSubpixels - 1);
    t.firstX = hn::Max(hn::ShiftRight<kSubpixelBits>(hn::Add(minOf(a.x, b.x, c.x), round)), hn::Zero(kInts));
    t.lastX = hn::Min(hn::ShiftRight<kSubpixelBits>(maxOf(a.x, b.x, c.x)), hn::Set(kInts, tile.width() - 1));
    // Padding triangles in the last SIMD vector can lie anywhere, so firstY is clamped to the tile.
    t.lastY = hn::Set(kInts, tile.y1 - 1 - above);
    t.firstY = hn::Min(hn::Max(rows.firstRow(minOf(a.y, b.y, c.y)), hn::Set(kInts, tile.y0 - above)), t.lastY);
    lanes.firstUnits = rows.row(t.firstY);
    lanes.highestUnits = maxOf(a.y, b.y, c.y);
    const PointLanes first = {hn::ShiftLeft<kSubpixelBits>(t.firstX), lanes.firstUnits};
    setEdge(b, c, first, t.edges.e0, t.perX.e0, t.perY.e0);
    setEdge(c, a, first, t.edges.e1, t.perX.e1, t.perY.e1);
    setEdge(a, b, first, t.edges.e2, t.perX.e2, t.perY.e2);
    // The increments from setEdge are per pixel, but increments from row to row must be per unit of the band.
    t.perY.e0 = hn::ShiftRight<kSubpixelBits>(t.perY.e0);
    t.perY.e1 = hn::ShiftRight<kSubpixelBits>(t.perY.e1);
    t.perY.e2 = hn::ShiftRight<kSubpixelBits>(t.perY.e2);
    lanes.referenceUnits = hn::ShiftLeft<kSubpixelBits>(hn::ShiftRight<kSubpixelBits>(a.y));
    const RestLanes rest = source.restAt(i0);
    SideLanes side1(a, b, rest, source.restAt(i1));
    SideLanes side2(a, c, rest, source.restAt(i2));
    setDepth(a, rest, side1, side2, hn::ConvertTo(kFloats, area), cornerDepths(cluster, i0, i1, i2), t);
    return lanes;
}

HWY_INLINE Edges atUnits(const TriangleLanes& t, Ints unitsFromFirst) {
    return {
        hn::Add(t.edges.e0, hn::Mul(t.perY.e0, unitsFromFirst)),
        hn::Add(t.edges.e1, hn::Mul(t.perY.e1, unitsFromFirst)),
        hn::Add(t.edges.e2, hn::Mul(t.perY.e2, unitsFromFirst))};
}

/// Draws triangles that cover at most `side` x `side` pixel centres, with one triangle per SIMD lane.
template <int side>
HWY_INLINE void drawSmallUneven(
    const SnappedCluster& cluster,
    const UnevenSource& source,
    const Sorted& sorted,
    const BandLanes& rows,
    DepthTile& target) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    const auto firstRow = hn::Set(kInts, rows.tile->y0 - rows.band->first);
    Hits hits; // NOLINT(cppcoreguidelines-pro-type-member-init): elements are set when `count` grows
    for (std::uint32_t first = 0; first < sorted.count; first += lanes) {
        const auto corners = sorted.at(first);
        const UnevenLanes triangle = unevenLanes(cluster, source, corners, rows);
        const TriangleLanes& t = triangle.t;
        hits.count = 0;
        for (int y = 0; y < side; ++y) {
            const auto row = hn::Add(t.firstY, hn::Set(kInts, y));
            const auto units = rows.row(hn::Min(row, t.lastY));
            const auto isOfTile = hn::And(t.hasArea, isLessOrEqual(row, t.lastY));
            const auto isRow = hn::And(isOfTile, isLessOrEqual(units, triangle.highestUnits));
            if (hn::AllFalse(kInts, isRow)) break;
            Edges e = atUnits(t, hn::Sub(units, triangle.firstUnits));
            const auto rowDepth = depthOfRow(t.depth, fromReference(units, triangle.referenceUnits));
            const auto rowAddress = hn::Mul(hn::Sub(row, firstRow), hn::Set(kInts, kTileStride));
            for (int x = 0; x < side; ++x, step(e, t.perX)) {
                const auto column = hn::Add(t.firstX, hn::Set(kInts, x));
                const auto inside = hn::And(hn::And(isRow, isLessOrEqual(column, t.lastX)), isInside(e));
                if (hn::AllFalse(kInts, inside)) continue;
                hits.add<false>(
                    inside,
                    hn::Add(rowAddress, column),
                    depthAt(t.depth, rowDepth, hn::Add(t.depth.fromX, hn::Set(kFloats, static_cast<float>(x)))),
                    corners);
            }
        }
        target.takeHits(hits);
        target.count(hits.count);
    }
}

/// Draws triangle `lane` of the stored triangles, with one pixel per SIMD lane.
HWY_INLINE void drawStoredUneven(
    const StoredLanes& s,
    std::uint32_t lane,
    std::int32_t referenceUnits,
    std::int32_t highestUnits,
    const BandLanes& rows,
    DepthTile& target) {
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(kInts));
    const std::int32_t firstRow = rows.tile->y0 - rows.band->first;
    const std::int32_t* units = rows.band->rows.data();
    const auto edgeAlong = [&](std::size_t k) HWY_ATTR { return along(s.edges[k][lane], s.perX[k][lane]); };
    const Edges first = {edgeAlong(0), edgeAlong(1), edgeAlong(2)};
    const auto value = [&](std::size_t k) HWY_ATTR { return hn::Set(kFloats, s.depth[k][lane]); };
    const DepthLanes depth = {value(0), value(1), value(2), value(3), value(4), value(5), value(6)};
    // Local copies avoid reloads. The compiler must assume that writes to the tile change the stored values.
    const auto [x0, y0, x1, y1] =
        std::array<std::int32_t, 4>{s.box[0][lane], s.box[1][lane], s.box[2][lane], s.box[3][lane]};
    const std::array<std::int32_t, 3> perY = {s.perY[0][lane], s.perY[1][lane], s.perY[2][lane]};
    const auto perVector = [&](std::size_t k) HWY_ATTR { return hn::Set(kInts, s.perX[k][lane] * lanes); };
    const Edges perX = {perVector(0), perVector(1), perVector(2)};
    const auto lastX = hn::Set(kInts, x1);
    const std::int32_t firstUnits = units[y0];
    for (std::int32_t y = y0; y <= y1 && units[y] <= highestUnits; ++y) {
        const std::int32_t up = units[y] - firstUnits;
        const auto at = [&](Ints edge, std::size_t k) HWY_ATTR { return hn::Add(edge, hn::Set(kInts, perY[k] * up)); };
        Edges e = {at(first.e0, 0), at(first.e1, 1), at(first.e2, 2)};
        const auto rowDepth =
            depthOfRow(depth, hn::Set(kFloats, static_cast<float>(units[y] - referenceUnits) * (1.0F / kSubpixels)));
        for (std::int32_t x = x0; x <= x1; x += lanes, step(e, perX)) {
            const auto inside = hn::And(isInside(e), isLessOrEqual(hn::Iota(kInts, x), lastX));
            if (hn::AllFalse(kInts, inside)) continue;
            const auto fromX = hn::Add(depth.fromX, hn::Iota(kFloats, static_cast<float>(x - x0)));
            target.takeRow((y - firstRow) * kTileStride + x, inside, depthAt(depth, rowDepth, fromX), 0);
            target.count(hn::CountTrue(kInts, inside));
        }
    }
}

HWY_INLINE void drawNarrowUneven(
    const SnappedCluster& cluster,
    const UnevenSource& source,
    const Sorted& sorted,
    const BandLanes& rows,
    DepthTile& target) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    for (std::uint32_t first = 0; first < sorted.count; first += lanes) {
        const auto corners = sorted.at(first);
        const UnevenLanes triangle = unevenLanes(cluster, source, corners, rows);
        StoredLanes stored; // NOLINT(cppcoreguidelines-pro-type-member-init): `take` fills it
        stored.take(triangle.t);
        alignas(64) StoredLanes::Lanes<std::int32_t> references;
        alignas(64) StoredLanes::Lanes<std::int32_t> highest;
        hn::Store(triangle.referenceUnits, kInts, references.data());
        hn::Store(triangle.highestUnits, kInts, highest.data());
        const std::uint32_t end = std::min(lanes, sorted.count - first);
        for (std::uint32_t lane = 0; lane < end; ++lane)
            if (stored.hasArea[lane] != 0)
                drawStoredUneven(stored, lane, references[lane], highest[lane], rows, target);
    }
}

HWY_INLINE void drawWideUneven(
    const SnappedCluster& cluster,
    const BandVertices& vertices,
    std::uint32_t packed,
    const BandLanes& rows,
    DepthTile& target) {
    std::array<UnevenVertex, 3> corners;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t index = packed >> (8 * i) & 0xFFU;
        const SnappedArrays& from = cluster.vertices;
        corners[i] = unevenVertex(
            *rows.band,
            {vertices.x[index],
             from.y[index],
             from.z[index],
             static_cast<std::int16_t>(vertices.rests[index] & 0xFFFFU),
             std::int16_t{0}});
    }
    const UnevenTriangle triangle(corners);
    if (!triangle.hasArea() || !triangle.mayTouch(*rows.band, *rows.tile)) return;
    const auto minDepth = hn::Set(kFloats, triangle.minDepth());
    const auto maxDepth = hn::Set(kFloats, triangle.maxDepth());
    const auto perX = hn::Set(kFloats, triangle.depthPerX());
    const auto referenceX = hn::Set(kInts, triangle.referenceX());
    const PixelBox& tile = *rows.tile;
    const auto [lowest, highest] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const std::span<const std::int32_t> units(
        rows.band->rows.data() + (tile.y0 - rows.band->first), static_cast<std::size_t>(tile.height()));
    const auto first = std::lower_bound(units.begin(), units.end(), lowest);
    const auto after = std::upper_bound(first, units.end(), highest);
    const auto rowAt = [&](auto place) { return tile.y0 + static_cast<int>(place - units.begin()); };
    for (int y = rowAt(first); y < rowAt(after); ++y) {
        const WideRow row = triangle.row(*rows.band, y, tile.x0, tile.x1);
        if (row.x0 >= row.x1) continue;
        const auto reference = hn::Set(kFloats, row.depthAtReference);
        const auto end = hn::Set(kInts, row.x1);
        target.count(static_cast<std::size_t>(row.x1 - row.x0));
        for (int x = row.x0; x < row.x1; x += static_cast<int>(hn::Lanes(kInts))) {
            const auto pixels = hn::Iota(kInts, x);
            const auto along = hn::ConvertTo(kFloats, hn::Sub(pixels, referenceX));
            const auto depth = hn::Min(hn::Max(hn::Add(reference, hn::Mul(perX, along)), minDepth), maxDepth);
            target.takeRow((y - tile.y0) * kTileStride + x - tile.x0, hn::Lt(pixels, end), depth, 0);
        }
    }
}

std::uint64_t drawUnevenInLanes(const TileWork& work, const RowBand& band, float* depths) {
    DepthTile target{depths};
    SortedCluster sorted;  // NOLINT(cppcoreguidelines-pro-type-member-init): sortUneven fills it
    BandVertices vertices; // NOLINT(cppcoreguidelines-pro-type-member-init): filled for each cluster
    const BandLanes rows{&band, &work.box};
    for (const std::uint32_t index : work.indices) {
        const SnappedCluster& cluster = work.clusters[index];
        if (cluster.box.y1 <= work.box.y0 || cluster.box.y0 >= work.box.y1) continue;
        if (cluster.box.x1 <= work.box.x0 || cluster.box.x0 >= work.box.x1) continue;
        vertices.take(cluster, rows);
        const UnevenSource source(vertices, rows);
        sortUneven(cluster, vertices, source, rows, sorted);
        drawSmallUneven<2>(cluster, source, sorted.tiny, rows, target);
        drawSmallUneven<4>(cluster, source, sorted.small, rows, target);
        drawNarrowUneven(cluster, source, sorted.narrow, rows, target);
        for (std::uint32_t i = 0; i < sorted.wide.count; ++i)
            drawWideUneven(cluster, vertices, sorted.wide.packed[i], rows, target);
    }
    return target.covered;
}

} // namespace gnomon::raster::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::raster {

HWY_EXPORT(drawUnevenInLanes);

std::uint64_t drawUnevenTile(const TileWork& work, const RowBands& rows, float* depths) {
    std::uint64_t covered = 0;
    for (const RowBand& band : rows.bands()) {
        const int y0 = std::max(band.first, work.box.y0);
        const int y1 = std::min(band.end, work.box.y1);
        if (y0 >= y1) continue;
        const TileWork part{{work.box.x0, y0, work.box.x1, y1}, work.clusters, work.indices};
        float* from = depths + static_cast<std::size_t>(y0 - work.box.y0) * kTileStride;
        covered += HWY_DYNAMIC_DISPATCH(drawUnevenInLanes)(part, band, from);
    }
    return covered;
}

} // namespace gnomon::raster
#endif
