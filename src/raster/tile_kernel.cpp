#include "raster/tile_kernel.h"

#include "raster/prefetch.h"
#include "raster/wide_triangle.h"

#include <algorithm>

// The order matters: foreach_target.h includes this file again for each instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/tile_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "raster/hidden_lanes-inl.h"
#include "raster/sorted_triangles-inl.h"
#include "raster/stored_lanes-inl.h"
#include "raster/tile_target-inl.h"
#include "raster/triangle_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {

HWY_INLINE TriangleBits bitsOf(const SortedCluster& sorted) {
    TriangleBits bits{};
    for (const Sorted* some : {&sorted.tiny, &sorted.small, &sorted.narrow, &sorted.wide})
        for (std::uint32_t i = 0; i < some->count; ++i)
            bits[some->packed[i] >> 30U] |= std::uint64_t{1} << (some->packed[i] >> 24U & 63U);
    return bits;
}

/// Sorts the triangles of a cluster into size classes. The function skips triangles that cover no pixel centre of the
/// tile. With occlusion tests, it also skips triangles that are hidden by drawn pixels.
template <bool isCompact, class Target>
HWY_INLINE void sortTriangles(
    const SnappedCluster& cluster, const PixelBox& tile, Target& target, SortedCluster& sorted) {
    PackedTriangles packed; // NOLINT(cppcoreguidelines-pro-type-member-init): packTriangles fills it
    packTriangles(cluster.triangles, packed);
    sorted.clear();
    const CornerSource<isCompact> cornerAt(cluster, tile);
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    bool skipsHidden = false;
    if constexpr (Target::kHasIds)
        skipsHidden = target.farthest != nullptr && mayHideSome<isCompact>(cluster, tile, target);
    for (std::uint32_t first = 0; first < cluster.triangles.size(); first += lanes) {
        const auto corners = hn::BitCast(kInts, hn::LoadU(kUints, packed.data() + first));
        const ExtentLanes extent = extentLanes(
            cornerAt(cornerIndex<0>(corners)),
            cornerAt(cornerIndex<1>(corners)),
            cornerAt(cornerIndex<2>(corners)),
            tile);
        auto drawn = extent.overlaps;
        if constexpr (Target::kHasIds) {
            if (skipsHidden && !hn::AllFalse(kInts, drawn))
                drawn = hn::AndNot(isHidden(cluster, corners, extent, target), drawn);
        }
        sorted.tiny.add(corners, hn::And(drawn, extent.isTiny));
        sorted.small.add(corners, hn::And(drawn, hn::AndNot(extent.isTiny, extent.isSmall)));
        const auto larger = hn::AndNot(extent.isSmall, drawn);
        if (hn::AllFalse(kInts, larger)) continue;
        sorted.narrow.add(corners, hn::And(larger, extent.isNarrow));
        sorted.wide.add(corners, hn::AndNot(extent.isNarrow, larger));
    }
    sorted.pad();
    if constexpr (Target::kHasIds) target.setUp = bitsOf(sorted);
}

/// Returns true if a cluster extends beyond the right or upper edge of the tile. Its pixels may then be in the margin
/// of the tile's memory.
HWY_INLINE bool reachesOverEdge(const SnappedCluster& cluster, const PixelBox& tile) {
    return cluster.box.x1 > tile.x1 || cluster.box.y1 > tile.y1;
}

/// Returns a mask of the SIMD lanes whose pixel is outside the tile. The pixel is in column x and row y, counted from
/// the first pixel of the lane's triangle.
HWY_INLINE IntMask isOutside(const TriangleLanes& t, int x, int y) {
    return hn::Or(
        hn::Gt(hn::Add(t.firstX, hn::Set(kInts, x)), t.lastX), hn::Gt(hn::Add(t.firstY, hn::Set(kInts, y)), t.lastY));
}

/// Subtracts covered pixels outside the tile from the pixel count of `target`.
template <class Target>
HWY_INLINE void discountOutside(
    const TriangleLanes& t, IntMask inside, int x, int y, bool reachesOver, Target& target) {
    if constexpr (Target::kCounts)
        if (reachesOver) target.discount(hn::CountTrue(kInts, hn::And(inside, isOutside(t, x, y))));
}

/// Draws triangles that cover at most `side` x `side` pixel centres, with one triangle per SIMD lane.
template <bool isCompact, int side, class Target>
HWY_INLINE void drawSmall(const SnappedCluster& cluster, const Sorted& sorted, const PixelBox& tile, Target& target) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    const bool reachesOver = reachesOverEdge(cluster, tile);
    Hits hits; // NOLINT(cppcoreguidelines-pro-type-member-init): elements are set when `count` grows
    for (std::uint32_t first = 0; first < sorted.count; first += lanes) {
        const auto corners = sorted.at(first);
        TriangleLanes t = triangleLanes<isCompact>(cluster, corners, tile);
        const auto ids = Target::kHasIds ? triangleIds(cluster, corners) : corners;
        hits.count = 0;
        auto rowAddress = hn::Add(hn::Mul(t.firstY, hn::Set(kInts, kTileStride)), t.firstX);
        for (int y = 0; y < side; ++y) {
            Edges e = t.edges;
            const auto rowDepth = depthOfRow(t.depth, hn::Add(t.depth.fromY, hn::Set(kFloats, static_cast<float>(y))));
            for (int x = 0; x < side; ++x, step(e, t.perX)) {
                const auto inside = hn::And(t.hasArea, isInside(e));
                if (hn::AllFalse(kInts, inside)) continue;
                hits.add<Target::kHasIds>(
                    inside,
                    hn::Add(rowAddress, hn::Set(kInts, x)),
                    depthAt(t.depth, rowDepth, hn::Add(t.depth.fromX, hn::Set(kFloats, static_cast<float>(x)))),
                    ids);
                discountOutside(t, inside, x, y, reachesOver, target);
            }
            step(t.edges, t.perY);
            rowAddress = hn::Add(rowAddress, hn::Set(kInts, kTileStride));
        }
        target.takeHits(hits);
        if constexpr (Target::kCounts) target.count(hits.count);
    }
}

/// Draws narrow triangles one after another, with one pixel per SIMD lane. Their setup is computed before, with one
/// triangle per SIMD lane.
template <bool isCompact, class Target>
HWY_INLINE void drawNarrow(const SnappedCluster& cluster, const Sorted& sorted, const PixelBox& tile, Target& target) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    for (std::uint32_t first = 0; first < sorted.count; first += lanes) {
        const auto corners = sorted.at(first);
        StoredLanes stored; // NOLINT(cppcoreguidelines-pro-type-member-init): `take` fills it
        stored.take(triangleLanes<isCompact>(cluster, corners, tile));
        hn::Store(hn::BitCast(kUints, triangleIds(cluster, corners)), kUints, stored.ids.data());
        const std::uint32_t end = std::min(lanes, sorted.count - first);
        for (std::uint32_t lane = 0; lane < end; ++lane)
            if (stored.hasArea[lane] != 0) drawStored(stored, lane, reachesOverEdge(cluster, tile), target);
    }
}

HWY_INLINE SnappedVertex vertexAt(const SnappedCluster& cluster, std::uint32_t index) {
    const SnappedArrays& from = cluster.vertices;
    SnappedVertex vertex;
    vertex.z = from.z[index];
    vertex.restX = static_cast<std::int16_t>(from.rests[index] & 0xFFFFU);
    vertex.restY = static_cast<std::int16_t>(from.rests[index] >> 16U);
    if (cluster.isCompact) {
        const auto word = static_cast<std::uint32_t>(from.x[index]);
        vertex.x = static_cast<std::int32_t>(word & 0xFFFFU) + (cluster.box.x0 - 1) * kSubpixels;
        vertex.y = static_cast<std::int32_t>(word >> 16U) + (cluster.box.y0 - 1) * kSubpixels;
    } else {
        vertex.x = from.x[index];
        vertex.y = from.y[index];
    }
    return vertex;
}

template <class Target>
HWY_INLINE void drawWide(const SnappedCluster& cluster, std::uint32_t packed, const PixelBox& tile, Target& target) {
    std::array<SnappedVertex, 3> corners;
    for (std::uint32_t i = 0; i < 3; ++i)
        corners[i] = vertexAt(cluster, packed >> (8 * i) & 0xFFU);
    if (doubleArea(corners) == 0) return;
    const std::uint32_t place = packed >> 24U;
    const std::uint32_t id =
        cluster.triangleIds == nullptr ? cluster.firstTriangleId + place : cluster.triangleIds[place];
    const WideTriangle triangle = wideTriangle(corners);
    const auto minDepth = hn::Set(kFloats, triangle.minDepth);
    const auto maxDepth = hn::Set(kFloats, triangle.maxDepth);
    WideRows rows(triangle, tile);
    const auto perX = hn::Set(kFloats, rows.depthPerX());
    const auto referenceX = hn::Set(kInts, rows.referenceX());
    while (!rows.atEnd()) {
        const WideRow row = rows.next();
        const auto reference = hn::Set(kFloats, row.depthAtReference);
        const auto end = hn::Set(kInts, row.x1);
        if constexpr (Target::kCounts) target.count(static_cast<std::size_t>(std::max(row.x1 - row.x0, 0)));
        for (int x = row.x0; x < row.x1; x += static_cast<int>(hn::Lanes(kInts))) {
            const auto pixels = hn::Iota(kInts, x);
            const auto along = hn::ConvertTo(kFloats, hn::Sub(pixels, referenceX));
            const auto depth = hn::Min(hn::Max(hn::Add(reference, hn::Mul(perX, along)), minDepth), maxDepth);
            target.takeRow((row.y - tile.y0) * kTileStride + x - tile.x0, hn::Lt(pixels, end), depth, id);
        }
    }
}

template <bool isCompact, class Target>
HWY_INLINE void drawCluster(
    const SnappedCluster& cluster, const PixelBox& tile, SortedCluster& sorted, Target& target) {
    sortTriangles<isCompact>(cluster, tile, target, sorted);
    drawSmall<isCompact, 2>(cluster, sorted.tiny, tile, target);
    drawSmall<isCompact, 4>(cluster, sorted.small, tile, target);
    drawNarrow<isCompact>(cluster, sorted.narrow, tile, target);
    for (std::uint32_t i = 0; i < sorted.wide.count; ++i)
        drawWide(cluster, sorted.wide.packed[i], tile, target);
}

HWY_INLINE void prefetchCluster(const SnappedCluster& cluster) {
    prefetch(cluster.vertices.x, cluster.vertexCount * sizeof(std::int32_t));
    prefetch(cluster.vertices.z, cluster.vertexCount * sizeof(float));
    prefetch(cluster.vertices.rests, cluster.vertexCount * sizeof(std::uint32_t));
    prefetch(cluster.triangles.data(), cluster.triangles.size_bytes());
}

template <class Target>
HWY_INLINE void drawTile(const TileWork& work, Target& target) {
    SortedCluster sorted; // NOLINT(cppcoreguidelines-pro-type-member-init): sortTriangles fills it
    for (std::size_t k = 0; k < work.indices.size(); ++k) {
        if (k + 1 < work.indices.size()) prefetchCluster(work.clusters[work.indices[k + 1]]);
        const SnappedCluster& cluster = work.clusters[work.indices[k]];
        if (cluster.isCompact)
            drawCluster<true>(cluster, work.box, sorted, target);
        else
            drawCluster<false>(cluster, work.box, sorted, target);
    }
}

std::uint64_t drawDepthInLanes(const TileWork& work, float* depths) {
    DepthTile tile{depths};
    drawTile(work, tile);
    return tile.covered;
}

TriangleBits drawVisibilityInLanes(const TileWork& work, std::uint64_t* words, FarthestDepths<WordDepths>* farthest) {
    VisibilityTile tile{words, farthest};
    drawTile(work, tile);
    return tile.setUp;
}

} // namespace gnomon::raster::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::raster {

HWY_EXPORT(drawDepthInLanes);
HWY_EXPORT(drawVisibilityInLanes);

std::uint64_t drawDepthTile(const TileWork& work, float* depths) {
    return HWY_DYNAMIC_DISPATCH(drawDepthInLanes)(work, depths);
}

TriangleBits drawVisibilityTile(const TileWork& work, std::uint64_t* words, FarthestDepths<WordDepths>* farthest) {
    return HWY_DYNAMIC_DISPATCH(drawVisibilityInLanes)(work, words, farthest);
}

} // namespace gnomon::raster
#endif
