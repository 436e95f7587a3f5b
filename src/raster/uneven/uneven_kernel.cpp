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

/// A corner of each lane's triangle: x from the tile's first column, y in the band's units, with what snapping cut off.
struct UnevenCorner {
    PointLanes at;
    RestLanes rest;
};

class UnevenSource {
public:
    HWY_INLINE UnevenSource(const SnappedCluster& cluster, const BandLanes& rows)
        : cluster_(cluster),
          originX_(hn::Set(kInts, -rows.tile->x0 * kSubpixels)),
          base_(hn::Set(kFloats, rows.band->base)),
          scale_(hn::Set(kFloats, rows.band->scale)) {}

    HWY_INLINE Floats unitsAt(Ints index) const {
        const auto y = hn::BitCast(kFloats, hn::GatherIndex(kInts, cluster_.vertices.y, index));
        const auto units = hn::Mul(hn::Sub(y, base_), scale_);
        const auto far = hn::Set(kFloats, kFarUnits);
        return hn::Min(hn::Max(units, hn::Neg(far)), far);
    }

    HWY_INLINE PointLanes pointAt(Ints index) const {
        return {hn::Add(hn::GatherIndex(kInts, cluster_.vertices.x, index), originX_), hn::NearestInt(unitsAt(index))};
    }

    HWY_INLINE UnevenCorner operator()(Ints index) const {
        const auto units = unitsAt(index);
        const auto y = hn::NearestInt(units);
        const auto x = hn::Add(hn::GatherIndex(kInts, cluster_.vertices.x, index), originX_);
        return {{x, y}, {restLanes(cluster_, index).x, hn::Sub(units, hn::ConvertTo(kFloats, y))}};
    }

private:
    const SnappedCluster& cluster_;
    Ints originX_;
    Floats base_;
    Floats scale_;
};

/// The samples of the tile between the extremes of each lane's triangle; rows from the band's first.
struct SampleLanes {
    Ints firstX, lastX, firstRow, lastRow;
};

HWY_INLINE SampleLanes
samplesBetween(const BandLanes& rows, const PointLanes& a, const PointLanes& b, const PointLanes& c) {
    const PixelBox& tile = *rows.tile;
    const int above = rows.band->first;
    const auto round = hn::Set(kInts, kSubpixels - 1);
    const auto one = hn::Set(kInts, 1);
    return {
        hn::Max(hn::ShiftRight<kSubpixelBits>(hn::Add(least(a.x, b.x, c.x), round)), hn::Zero(kInts)),
        hn::Min(hn::ShiftRight<kSubpixelBits>(largest(a.x, b.x, c.x)), hn::Set(kInts, tile.width() - 1)),
        hn::Max(rows.firstRow(least(a.y, b.y, c.y)), hn::Set(kInts, tile.y0 - above)),
        hn::Min(
            hn::Sub(rows.firstRow(hn::Add(largest(a.y, b.y, c.y), one)), one), hn::Set(kInts, tile.y1 - 1 - above))};
}

/// Leaves out the triangles that no sample of the tile can be inside of; sorts the rest by how many they may cover.
HWY_INLINE void sortUneven(const SnappedCluster& cluster, const BandLanes& rows, SortedCluster& sorted) {
    PackedTriangles packed; // NOLINT(cppcoreguidelines-pro-type-member-init): packTriangles fills it
    packTriangles(cluster.triangles, packed);
    sorted.clear();
    const UnevenSource source(cluster, rows);
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    const auto narrow = hn::Set(kInts, kNarrowExtent);
    for (std::uint32_t first = 0; first < cluster.triangles.size(); first += lanes) {
        const auto corners = hn::BitCast(kInts, hn::LoadU(kUints, packed.data() + first));
        const PointLanes a = source.pointAt(cornerIndex<0>(corners));
        const PointLanes b = source.pointAt(cornerIndex<1>(corners));
        const PointLanes c = source.pointAt(cornerIndex<2>(corners));
        const SampleLanes samples = samplesBetween(rows, a, b, c);
        const auto columns = hn::Sub(samples.lastX, samples.firstX);
        const auto rowCount = hn::Sub(samples.lastRow, samples.firstRow);
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

/// Set-up triangles: their first samples, the units of the first row, and the row that depth is counted from.
struct UnevenLanes {
    TriangleLanes t; // its rows from the band's first
    Ints firstUnits;
    Ints referenceUnits;
};

/// What lies `units` up from the first row, in pixels of 256 units from the reference.
HWY_INLINE Floats fromReference(Ints units, Ints referenceUnits) {
    const auto pixels = hn::Set(kFloats, 1.0F / kSubpixels);
    return hn::Mul(hn::ConvertTo(kFloats, hn::Sub(units, referenceUnits)), pixels);
}

/// Sets up a narrow triangle in each lane, turned counter-clockwise.
HWY_INLINE UnevenLanes unevenLanes(const SnappedCluster& cluster, Ints packed, const BandLanes& rows) {
    const UnevenSource source(cluster, rows);
    const auto i0 = cornerIndex<0>(packed);
    auto i1 = cornerIndex<1>(packed);
    auto i2 = cornerIndex<2>(packed);
    const UnevenCorner a = source(i0);
    UnevenCorner b = source(i1);
    UnevenCorner c = source(i2);
    auto area = hn::Sub(
        hn::Mul(hn::Sub(b.at.x, a.at.x), hn::Sub(c.at.y, a.at.y)),
        hn::Mul(hn::Sub(c.at.x, a.at.x), hn::Sub(b.at.y, a.at.y)));
    const auto turned = hn::Lt(area, hn::Zero(kInts));
    const auto turnedFloats = hn::RebindMask(kFloats, turned);
    area = hn::Abs(area);
    const auto swap = [&](auto& p, auto& q, auto mask) HWY_ATTR {
        const auto old = p;
        p = hn::IfThenElse(mask, q, p);
        q = hn::IfThenElse(mask, old, q);
    };
    swap(b.at.x, c.at.x, turned);
    swap(b.at.y, c.at.y, turned);
    swap(b.rest.x, c.rest.x, turnedFloats);
    swap(b.rest.y, c.rest.y, turnedFloats);
    swap(i1, i2, turned);

    const SampleLanes samples = samplesBetween(rows, a.at, b.at, c.at);
    UnevenLanes lanes;
    TriangleLanes& t = lanes.t;
    t.hasArea = hn::Gt(area, hn::Zero(kInts));
    t.firstX = samples.firstX;
    t.lastX = samples.lastX;
    // What fills up the last vector may lie anywhere.
    const auto lastOfBand = hn::Set(kInts, rows.band->count() - 1);
    t.firstY = hn::Min(samples.firstRow, lastOfBand);
    t.lastY = hn::Max(samples.lastRow, hn::Zero(kInts));
    lanes.firstUnits = rows.row(t.firstY);
    const PointLanes first = {hn::ShiftLeft<kSubpixelBits>(t.firstX), lanes.firstUnits};
    setEdge(b.at, c.at, first, t.edges.e0, t.perX.e0, t.perY.e0);
    setEdge(c.at, a.at, first, t.edges.e1, t.perX.e1, t.perY.e1);
    setEdge(a.at, b.at, first, t.edges.e2, t.perX.e2, t.perY.e2);
    // Of a unit, not of a pixel.
    t.perY.e0 = hn::ShiftRight<kSubpixelBits>(t.perY.e0);
    t.perY.e1 = hn::ShiftRight<kSubpixelBits>(t.perY.e1);
    t.perY.e2 = hn::ShiftRight<kSubpixelBits>(t.perY.e2);
    lanes.referenceUnits = hn::ShiftLeft<kSubpixelBits>(hn::ShiftRight<kSubpixelBits>(a.at.y));
    SideLanes side1(a.at, b.at, a.rest, b.rest);
    SideLanes side2(a.at, c.at, a.rest, c.rest);
    setDepth(
        a.at,
        a.rest,
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
    const SnappedCluster& cluster, const Sorted& sorted, const BandLanes& rows, DepthTile& target) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    const auto firstRow = hn::Set(kInts, rows.tile->y0 - rows.band->first);
    Hits hits; // NOLINT(cppcoreguidelines-pro-type-member-init): filled up to its count
    for (std::uint32_t first = 0; first < sorted.count; first += lanes) {
        const auto corners = hn::BitCast(kInts, hn::LoadU(kUints, sorted.packed.data() + first));
        const UnevenLanes triangle = unevenLanes(cluster, corners, rows);
        const TriangleLanes& t = triangle.t;
        hits.count = 0;
        for (int y = 0; y < side; ++y) {
            const auto row = hn::Add(t.firstY, hn::Set(kInts, y));
            const auto isRow = hn::And(t.hasArea, isAtMost(row, t.lastY));
            if (hn::AllFalse(kInts, isRow)) break;
            const auto units = rows.row(hn::Min(row, t.lastY));
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
    const StoredLanes& s, std::uint32_t lane, std::int32_t referenceUnits, const BandLanes& rows, DepthTile& target) {
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(kInts));
    const std::int32_t firstRow = rows.tile->y0 - rows.band->first;
    const std::int32_t* units = rows.band->rows.data();
    const auto edgeAlong = [&](std::size_t k) HWY_ATTR { return along(s.edges[k][lane], s.perX[k][lane]); };
    const Edges first = {edgeAlong(0), edgeAlong(1), edgeAlong(2)};
    const auto value = [&](std::size_t k) HWY_ATTR { return hn::Set(kFloats, s.depth[k][lane]); };
    const DepthLanes depth = {value(0), value(1), value(2), value(3), value(4), value(5), value(6)};
    const auto lastX = hn::Set(kInts, s.box[2][lane]);
    for (std::int32_t y = s.box[1][lane]; y <= s.box[3][lane]; ++y) {
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
    const SnappedCluster& cluster, const Sorted& sorted, const BandLanes& rows, DepthTile& target) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    for (std::uint32_t first = 0; first < sorted.count; first += lanes) {
        const auto corners = hn::BitCast(kInts, hn::LoadU(kUints, sorted.packed.data() + first));
        const UnevenLanes triangle = unevenLanes(cluster, corners, rows);
        StoredLanes stored; // NOLINT(cppcoreguidelines-pro-type-member-init): `take` fills it
        stored.take(triangle.t);
        alignas(64) StoredLanes::Lanes<std::int32_t> references;
        hn::Store(triangle.referenceUnits, kInts, references.data());
        const std::uint32_t end = std::min(lanes, sorted.count - first);
        for (std::uint32_t lane = 0; lane < end; ++lane)
            if (stored.hasArea[lane] != 0) drawStoredUneven(stored, lane, references[lane], rows, target);
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
    for (int y = tile.y0; y < tile.y1; ++y) {
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
    SortedCluster sorted; // NOLINT(cppcoreguidelines-pro-type-member-init): sortUneven fills it
    const BandLanes rows{&band, &work.box};
    for (const std::uint32_t index : work.indices) {
        const SnappedCluster& cluster = work.clusters[index];
        if (cluster.box.y1 <= work.box.y0 || cluster.box.y0 >= work.box.y1) continue;
        sortUneven(cluster, rows, sorted);
        drawSmallUneven<2>(cluster, sorted.tiny, rows, target);
        drawSmallUneven<4>(cluster, sorted.small, rows, target);
        drawNarrowUneven(cluster, sorted.narrow, rows, target);
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
