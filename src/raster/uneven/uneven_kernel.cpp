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
// clang-format on

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {

/// Units further from a band than this are as good as this far: only the extremes of a triangle that is too large for
/// 32-bit edges are asked about there.
constexpr float kFarUnits = 0x1p29F; // so that differences fit an int

HWY_INLINE IntMask isAtMost(Ints a, Ints b) {
    return hn::Lt(a, hn::Add(b, hn::Set(kInts, 1)));
}

/// A band as its tiles see it.
struct BandLanes {
    const RowBand* band;
    const PixelBox* tile; // within the band

    HWY_INLINE Ints row(Ints index) const { return hn::GatherIndex(kInts, band->rows.data(), index); }

    /// The first row of `units` or more, from the band's first.
    HWY_INLINE Ints firstRow(Ints units) const {
        const auto last = hn::Set(kInts, static_cast<std::int32_t>(band->rowsFromBucket.size()) - 1);
        const auto bucket = hn::Min(hn::ShiftRight<kBucketBits>(hn::Max(units, hn::Zero(kInts))), last);
        const auto found = hn::GatherIndex(kInts, band->rowsFromBucket.data(), bucket);
        return hn::Sub(found, hn::VecFromMask(kInts, hn::Lt(row(found), units)));
    }
};

/// The vertices of a cluster snapped for a band: y in its units, and what snapping cut off, packed as of even rows.
/// Each serves about six corners, twice.
struct BandVertices { // NOLINT(cppcoreguidelines-pro-type-member-init): filled up to the cluster's count
    alignas(64) std::array<std::int32_t, kMaxClusterVertices> y;
    alignas(64) std::array<std::uint32_t, kMaxClusterVertices> rests;

    HWY_INLINE void take(const SnappedCluster& cluster, const RowBand& band) {
        const auto base = hn::Set(kFloats, band.base);
        const auto scale = hn::Set(kFloats, band.scale);
        const auto far = hn::Set(kFloats, kFarUnits);
        const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
        for (std::uint32_t i = 0; i < cluster.vertexCount; i += lanes) {
            const auto position = hn::BitCast(kFloats, hn::LoadU(kInts, cluster.vertices.y + i));
            const auto units = hn::Min(hn::Max(hn::Mul(hn::Sub(position, base), scale), hn::Neg(far)), far);
            const auto snapped = hn::NearestInt(units);
            const auto rest = hn::Mul(
                hn::Sub(units, hn::ConvertTo(kFloats, snapped)), hn::Set(kFloats, static_cast<float>(1 << kRestBits)));
            const auto restY = hn::NearestInt(hn::Min(rest, hn::Set(kFloats, 32767.0F)));
            const auto restX = hn::And(hn::LoadU(kUints, cluster.vertices.rests + i), hn::Set(kUints, 0xFFFFU));
            hn::StoreU(snapped, kInts, y.data() + i);
            hn::StoreU(hn::Or(restX, hn::BitCast(kUints, hn::ShiftLeft<16>(restY))), kUints, rests.data() + i);
        }
    }
};

/// Loads corners of a cluster's triangles: x from the tile's first column, y in the band's units.
class UnevenSource {
public:
    HWY_INLINE UnevenSource(const SnappedCluster& cluster, const BandVertices& vertices, const BandLanes& rows)
        : x_(cluster.vertices.x),
          y_(vertices.y.data()),
          rests_(reinterpret_cast<const std::int32_t*>(vertices.rests.data())),
          originX_(hn::Set(kInts, -rows.tile->x0 * kSubpixels)) {}

    HWY_INLINE PointLanes pointAt(Ints index) const {
        return {hn::Add(hn::GatherIndex(kInts, x_, index), originX_), hn::GatherIndex(kInts, y_, index)};
    }

    HWY_INLINE RestLanes restAt(Ints index) const { return unpackedRests(hn::GatherIndex(kInts, rests_, index)); }

private:
    const std::int32_t* x_;
    const std::int32_t* y_;
    const std::int32_t* rests_;
    Ints originX_;
};

/// Leaves out the triangles that no sample of the tile can be inside of; sorts the rest by how many they may cover.
HWY_INLINE void sortUneven(
    const SnappedCluster& cluster, const UnevenSource& source, const BandLanes& rows, SortedCluster& sorted) {
    PackedTriangles packed; // NOLINT(cppcoreguidelines-pro-type-member-init): packTriangles fills it
    packTriangles(cluster.triangles, packed);
    sorted.clear();
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    const auto narrow = hn::Set(kInts, kNarrowExtent);
    const auto one = hn::Set(kInts, 1);
    const auto round = hn::Set(kInts, kSubpixels - 1);
    const auto lastColumn = hn::Set(kInts, rows.tile->width() - 1);
    const auto firstOfTile = hn::Set(kInts, rows.tile->y0 - rows.band->first);
    const auto lastOfTile = hn::Set(kInts, rows.tile->y1 - 1 - rows.band->first);
    for (std::uint32_t first = 0; first < cluster.triangles.size(); first += lanes) {
        const auto corners = hn::BitCast(kInts, hn::LoadU(kUints, packed.data() + first));
        const PointLanes a = source.pointAt(cornerIndex<0>(corners));
        const PointLanes b = source.pointAt(cornerIndex<1>(corners));
        const PointLanes c = source.pointAt(cornerIndex<2>(corners));
        // The samples of the tile between the extremes; rows from the band's first.
        const auto firstX = hn::ShiftRight<kSubpixelBits>(hn::Add(least(a.x, b.x, c.x), round));
        const auto lastX = hn::Min(hn::ShiftRight<kSubpixelBits>(largest(a.x, b.x, c.x)), lastColumn);
        const auto lastRow = hn::Sub(rows.firstRow(hn::Add(largest(a.y, b.y, c.y), one)), one);
        const auto columns = hn::Sub(lastX, hn::Max(firstX, hn::Zero(kInts)));
        const auto rowCount =
            hn::Sub(hn::Min(lastRow, lastOfTile), hn::Max(rows.firstRow(least(a.y, b.y, c.y)), firstOfTile));
        const auto drawn = hn::Gt(hn::Min(columns, rowCount), hn::Set(kInts, -1));
        const auto isNarrow = hn::And(
            hn::Lt(hn::Sub(largest(a.x, b.x, c.x), least(a.x, b.x, c.x)), narrow),
            hn::Lt(hn::Sub(largest(a.y, b.y, c.y), least(a.y, b.y, c.y)), narrow));
        const auto reach = hn::Max(columns, rowCount);
        const auto isTiny = hn::And(isNarrow, hn::Lt(reach, hn::Set(kInts, 2)));
        const auto isSmall = hn::And(isNarrow, hn::Lt(reach, hn::Set(kInts, 4)));
        sorted.tiny.add(corners, hn::And(drawn, isTiny));
        sorted.small.add(corners, hn::And(drawn, hn::AndNot(isTiny, isSmall)));
        const auto larger = hn::AndNot(isSmall, drawn);
        if (hn::AllFalse(kInts, larger)) continue;
        sorted.narrow.add(corners, hn::And(larger, isNarrow));
        sorted.wide.add(corners, hn::AndNot(isNarrow, larger));
    }
    sorted.pad();
}

/// Set-up triangles: their first samples, the units of the first row and of the highest corner, and the row that depth
/// is counted from.
struct UnevenLanes {
    TriangleLanes t; // its rows from the band's first; the last one is the tile's
    Ints firstUnits;
    Ints highestUnits;
    Ints referenceUnits;
};

/// What lies `units` up from the first row, in pixels of 256 units from the reference.
HWY_INLINE Floats fromReference(Ints units, Ints referenceUnits) {
    const auto pixels = hn::Set(kFloats, 1.0F / kSubpixels);
    return hn::Mul(hn::ConvertTo(kFloats, hn::Sub(units, referenceUnits)), pixels);
}

/// Sets up a narrow triangle in each lane, turned counter-clockwise.
HWY_INLINE UnevenLanes
unevenLanes(const SnappedCluster& cluster, const UnevenSource& source, Ints packed, const BandLanes& rows) {
    const auto i0 = cornerIndex<0>(packed);
    auto i1 = cornerIndex<1>(packed);
    auto i2 = cornerIndex<2>(packed);
    const PointLanes a = source.pointAt(i0);
    PointLanes b = source.pointAt(i1);
    PointLanes c = source.pointAt(i2);
    auto area = hn::Sub(hn::Mul(hn::Sub(b.x, a.x), hn::Sub(c.y, a.y)), hn::Mul(hn::Sub(c.x, a.x), hn::Sub(b.y, a.y)));
    const auto turned = hn::Lt(area, hn::Zero(kInts));
    area = hn::Abs(area);
    const auto swapTurned = [&](Ints& p, Ints& q) HWY_ATTR {
        const auto old = p;
        p = hn::IfThenElse(turned, q, p);
        q = hn::IfThenElse(turned, old, q);
    };
    swapTurned(b.x, c.x);
    swapTurned(b.y, c.y);
    swapTurned(i1, i2);

    const PixelBox& tile = *rows.tile;
    const int above = rows.band->first;
    UnevenLanes lanes;
    TriangleLanes& t = lanes.t;
    t.hasArea = hn::Gt(area, hn::Zero(kInts));
    const auto round = hn::Set(kInts, kSubpixels - 1);
    t.firstX = hn::Max(hn::ShiftRight<kSubpixelBits>(hn::Add(least(a.x, b.x, c.x), round)), hn::Zero(kInts));
    t.lastX = hn::Min(hn::ShiftRight<kSubpixelBits>(largest(a.x, b.x, c.x)), hn::Set(kInts, tile.width() - 1));
    // What fills up the last vector may lie anywhere.
    t.lastY = hn::Set(kInts, tile.y1 - 1 - above);
    t.firstY = hn::Min(hn::Max(rows.firstRow(least(a.y, b.y, c.y)), hn::Set(kInts, tile.y0 - above)), t.lastY);
    lanes.firstUnits = rows.row(t.firstY);
    lanes.highestUnits = largest(a.y, b.y, c.y);
    const PointLanes first = {hn::ShiftLeft<kSubpixelBits>(t.firstX), lanes.firstUnits};
    setEdge(b, c, first, t.edges.e0, t.perX.e0, t.perY.e0);
    setEdge(c, a, first, t.edges.e1, t.perX.e1, t.perY.e1);
    setEdge(a, b, first, t.edges.e2, t.perX.e2, t.perY.e2);
    // Of a unit, not of a pixel.
    t.perY.e0 = hn::ShiftRight<kSubpixelBits>(t.perY.e0);
    t.perY.e1 = hn::ShiftRight<kSubpixelBits>(t.perY.e1);
    t.perY.e2 = hn::ShiftRight<kSubpixelBits>(t.perY.e2);
    lanes.referenceUnits = hn::ShiftLeft<kSubpixelBits>(hn::ShiftRight<kSubpixelBits>(a.y));
    const RestLanes rest = source.restAt(i0);
    SideLanes side1(a, b, rest, source.restAt(i1));
    SideLanes side2(a, c, rest, source.restAt(i2));
    setDepth(
        a,
        rest,
        side1,
        side2,
        hn::ConvertTo(kFloats, area),
        {hn::GatherIndex(kFloats, cluster.vertices.z, i0),
         hn::GatherIndex(kFloats, cluster.vertices.z, i1),
         hn::GatherIndex(kFloats, cluster.vertices.z, i2)},
        t);
    return lanes;
}

HWY_INLINE Edges atUnits(const TriangleLanes& t, Ints unitsFromFirst) {
    return {
        hn::Add(t.edges.e0, hn::Mul(t.perY.e0, unitsFromFirst)),
        hn::Add(t.edges.e1, hn::Mul(t.perY.e1, unitsFromFirst)),
        hn::Add(t.edges.e2, hn::Mul(t.perY.e2, unitsFromFirst))};
}

/// Tests `side` x `side` samples of each lane's triangle.
template <int side>
HWY_INLINE void drawSmallUneven(
    const SnappedCluster& cluster,
    const UnevenSource& source,
    const Sorted& sorted,
    const BandLanes& rows,
    DepthTile& target) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    const auto firstRow = hn::Set(kInts, rows.tile->y0 - rows.band->first);
    Hits hits; // NOLINT(cppcoreguidelines-pro-type-member-init): filled up to its count
    for (std::uint32_t first = 0; first < sorted.count; first += lanes) {
        const auto corners = hn::BitCast(kInts, hn::LoadU(kUints, sorted.packed.data() + first));
        const UnevenLanes triangle = unevenLanes(cluster, source, corners, rows);
        const TriangleLanes& t = triangle.t;
        hits.count = 0;
        for (int y = 0; y < side; ++y) {
            const auto row = hn::Add(t.firstY, hn::Set(kInts, y));
            const auto units = rows.row(hn::Min(row, t.lastY));
            const auto isOfTile = hn::And(t.hasArea, isAtMost(row, t.lastY));
            const auto isRow = hn::And(isOfTile, isAtMost(units, triangle.highestUnits));
            if (hn::AllFalse(kInts, isRow)) break;
            Edges e = atUnits(t, hn::Sub(units, triangle.firstUnits));
            const auto rowDepth = depthOfRow(t.depth, fromReference(units, triangle.referenceUnits));
            const auto rowAddress = hn::Mul(hn::Sub(row, firstRow), hn::Set(kInts, kTileStride));
            for (int x = 0; x < side; ++x, step(e, t.perX)) {
                const auto column = hn::Add(t.firstX, hn::Set(kInts, x));
                const auto inside = hn::And(hn::And(isRow, isAtMost(column, t.lastX)), isInside(e));
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

/// Draws the triangle of one lane, a vector of samples at a time.
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
    const auto lastX = hn::Set(kInts, s.box[2][lane]);
    for (std::int32_t y = s.box[1][lane]; y <= s.box[3][lane] && units[y] <= highestUnits; ++y) {
        const std::int32_t up = units[y] - units[s.box[1][lane]];
        const auto at = [&](Ints edge, std::size_t k, std::int32_t x) HWY_ATTR {
            return hn::Add(edge, hn::Set(kInts, s.perY[k][lane] * up + s.perX[k][lane] * (x - s.box[0][lane])));
        };
        const auto rowDepth =
            depthOfRow(depth, hn::Set(kFloats, static_cast<float>(units[y] - referenceUnits) * (1.0F / kSubpixels)));
        for (std::int32_t x = s.box[0][lane]; x <= s.box[2][lane]; x += lanes) {
            const Edges e = {at(first.e0, 0, x), at(first.e1, 1, x), at(first.e2, 2, x)};
            const auto inside = hn::And(isInside(e), isAtMost(hn::Iota(kInts, x), lastX));
            if (hn::AllFalse(kInts, inside)) continue;
            const auto fromX = hn::Add(depth.fromX, hn::Iota(kFloats, static_cast<float>(x - s.box[0][lane])));
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
        const auto corners = hn::BitCast(kInts, hn::LoadU(kUints, sorted.packed.data() + first));
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
    const SnappedCluster& cluster, std::uint32_t packed, const BandLanes& rows, DepthTile& target) {
    std::array<UnevenVertex, 3> corners;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t index = packed >> (8 * i) & 0xFFU;
        const SnappedArrays& from = cluster.vertices;
        corners[i] = unevenVertex(
            *rows.band,
            {from.x[index],
             from.y[index],
             from.z[index],
             static_cast<std::int16_t>(from.rests[index] & 0xFFFFU),
             std::int16_t{0}});
    }
    const UnevenTriangle triangle(corners);
    if (!triangle.hasArea()) return;
    const auto leastDepth = hn::Set(kFloats, triangle.leastDepth());
    const auto largestDepth = hn::Set(kFloats, triangle.largestDepth());
    const auto perX = hn::Set(kFloats, triangle.depthPerX());
    const auto referenceX = hn::Set(kInts, triangle.referenceX());
    const PixelBox& tile = *rows.tile;
    const auto [lowest, highest] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    for (int y = tile.y0; y < tile.y1; ++y) {
        const std::int64_t units = rows.band->rows[static_cast<std::size_t>(y - rows.band->first)];
        if (units < lowest || units > highest) continue;
        const WideRow row = triangle.row(*rows.band, y, tile.x0, tile.x1);
        if (row.x0 >= row.x1) continue;
        const auto reference = hn::Set(kFloats, row.depthAtReference);
        const auto end = hn::Set(kInts, row.x1);
        target.count(static_cast<std::size_t>(row.x1 - row.x0));
        for (int x = row.x0; x < row.x1; x += static_cast<int>(hn::Lanes(kInts))) {
            const auto pixels = hn::Iota(kInts, x);
            const auto along = hn::ConvertTo(kFloats, hn::Sub(pixels, referenceX));
            const auto depth = hn::Min(hn::Max(hn::Add(reference, hn::Mul(perX, along)), leastDepth), largestDepth);
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
        vertices.take(cluster, band);
        const UnevenSource source(cluster, vertices, rows);
        sortUneven(cluster, source, rows, sorted);
        drawSmallUneven<2>(cluster, source, sorted.tiny, rows, target);
        drawSmallUneven<4>(cluster, source, sorted.small, rows, target);
        drawNarrowUneven(cluster, source, sorted.narrow, rows, target);
        for (std::uint32_t i = 0; i < sorted.wide.count; ++i)
            drawWideUneven(cluster, sorted.wide.packed[i], rows, target);
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
