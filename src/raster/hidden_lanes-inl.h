// Occlusion test of triangles against the drawn pixels of a tile, with one triangle per SIMD lane. The test runs
// before triangle setup. The header is compiled once per SIMD instruction set.
#if defined(GNOMON_RASTER_HIDDEN_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RASTER_HIDDEN_LANES_INL_H
#undef GNOMON_RASTER_HIDDEN_LANES_INL_H
#else
#define GNOMON_RASTER_HIDDEN_LANES_INL_H
#endif

#include "raster/tile_target-inl.h"
#include "raster/triangle_lanes-inl.h"
#include "raster/wide_triangle.h"

#include <array>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The bounding box of one triangle per SIMD lane, in pixels of the tile, both ends included.
struct PixelLanes {
    Ints x0, y0, x1, y1;
};

/// Returns the nearness (an integer that is larger for nearer depths) of the nearest corner of one triangle per SIMD
/// lane. No pixel of the triangle is nearer, because pixel depths are clamped to the range of the corners and to [0,
/// 1].
HWY_INLINE Ints nearnessLanes(const SnappedCluster& cluster, Ints corners) {
    const auto depthAtCorner = [&](Ints index) HWY_ATTR { return hn::GatherIndex(kFloats, cluster.vertices.z, index); };
    const auto nearest = hn::Max(
        hn::Max(depthAtCorner(cornerIndex<0>(corners)), depthAtCorner(cornerIndex<1>(corners))),
        depthAtCorner(cornerIndex<2>(corners)));
    return hn::BitCast(kInts, withinUnit(nearest));
}

/// Tests triangles against the drawn pixels, and returns a mask of the hidden triangles: each pixel in their bounding
/// box shows a nearer triangle. `asked` is the mask of the triangles to test. Each bounding box has at most `side` x
/// `side` pixels.
HWY_INLINE IntMask
isHiddenAtPixels(IntMask asked, int side, const PixelLanes& pixels, Ints nearest, const VisibilityTile& target) {
    const auto zero = hn::Zero(kInts);
    for (int y = 0; y < side; ++y) {
        const auto row = hn::Max(hn::Min(hn::Add(pixels.y0, hn::Set(kInts, y)), pixels.y1), zero);
        const auto rowAddress = hn::Mul(row, hn::Set(kInts, kTileStride));
        for (int x = 0; x < side; ++x) {
            if (hn::AllFalse(kInts, asked)) return asked;
            const auto column = hn::Max(hn::Min(hn::Add(pixels.x0, hn::Set(kInts, x)), pixels.x1), zero);
            asked = hn::And(asked, hn::Gt(target.nearness(hn::Add(rowAddress, column)), nearest));
        }
    }
    return asked;
}

/// Returns a mask of the triangles in `asked` that are hidden: each pixel in their bounding box shows a nearer
/// triangle. The triangles can have any size. The function tests them one after another against the farthest depth of
/// each block.
HWY_INLINE IntMask isHiddenInBlocks(IntMask asked, const PixelLanes& pixels, Ints nearest, VisibilityTile& target) {
    using Lanes = std::array<std::int32_t, kMaxLanes>;
    Lanes x0;     // NOLINT(cppcoreguidelines-pro-type-member-init): StoreU sets all used elements
    Lanes y0;     // NOLINT(cppcoreguidelines-pro-type-member-init): StoreU sets all used elements
    Lanes x1;     // NOLINT(cppcoreguidelines-pro-type-member-init): StoreU sets all used elements
    Lanes y1;     // NOLINT(cppcoreguidelines-pro-type-member-init): StoreU sets all used elements
    Lanes near;   // NOLINT(cppcoreguidelines-pro-type-member-init): StoreU sets all used elements
    Lanes hidden; // NOLINT(cppcoreguidelines-pro-type-member-init): StoreU sets all used elements
    hn::StoreU(pixels.x0, kInts, x0.data());
    hn::StoreU(pixels.y0, kInts, y0.data());
    hn::StoreU(pixels.x1, kInts, x1.data());
    hn::StoreU(pixels.y1, kInts, y1.data());
    hn::StoreU(nearest, kInts, near.data());
    hn::StoreU(hn::VecFromMask(kInts, asked), kInts, hidden.data());
    for (std::size_t i = 0; i < hn::Lanes(kInts); ++i)
        if (hidden[i] != 0 &&
            !target.farthest->hides({x0[i], y0[i], x1[i] + 1, y1[i] + 1}, static_cast<std::uint32_t>(near[i])))
            hidden[i] = 0;
    return hn::MaskFromVec(hn::LoadU(kInts, hidden.data()));
}

/// Returns true if an occlusion test of the cluster's triangles is likely to pay off. The function tests at most
/// sixteen vertices of the cluster. The result is true if one of them is hidden at its pixel, or if none of them is in
/// the tile.
template <bool isCompact>
HWY_INLINE bool mayHideSome(const SnappedCluster& cluster, const PixelBox& tile, const VisibilityTile& target) {
    constexpr int kProbeBits = 4;
    const CornerSource<isCompact> cornerAt(cluster, tile);
    const auto outside = hn::Set(kInts, -1);
    bool isAnyInTile = false;
    for (int first = 0; first < 1 << kProbeBits; first += static_cast<int>(hn::Lanes(kInts))) {
        const auto index = hn::ShiftRight<kProbeBits>(
            hn::Mul(hn::Iota(kInts, first), hn::Set(kInts, static_cast<std::int32_t>(cluster.vertexCount))));
        const PointLanes corner = cornerAt(index);
        const auto x = hn::ShiftRight<kSubpixelBits>(corner.x);
        const auto y = hn::ShiftRight<kSubpixelBits>(corner.y);
        const auto isInTile = hn::And(
            hn::And(hn::Gt(x, outside), hn::Lt(x, hn::Set(kInts, tile.width()))),
            hn::And(hn::Gt(y, outside), hn::Lt(y, hn::Set(kInts, tile.height()))));
        if (hn::AllFalse(kInts, isInTile)) continue;
        isAnyInTile = true;
        const auto address = hn::IfThenElseZero(isInTile, hn::Add(hn::Mul(y, hn::Set(kInts, kTileStride)), x));
        const auto depth = hn::BitCast(kInts, withinUnit(hn::GatherIndex(kFloats, cluster.vertices.z, index)));
        if (!hn::AllFalse(kInts, hn::And(isInTile, hn::Gt(target.nearness(address), depth)))) return true;
    }
    return !isAnyInTile;
}

/// The bounding box and the size class of one triangle per SIMD lane.
struct ExtentLanes {
    PixelLanes within;
    IntMask overlaps; // true: the bounding box contains a pixel centre of the tile
    IntMask isTiny;
    IntMask isSmall;
    IntMask isNarrow;
};

HWY_INLINE ExtentLanes
extentLanes(const PointLanes& a, const PointLanes& b, const PointLanes& c, const PixelBox& tile) {
    const auto round = hn::Set(kInts, kSubpixels - 1);
    const auto subpixels = hn::Set(kInts, kSubpixels);
    const auto one = hn::Set(kInts, 1);
    const auto minX = minOf(a.x, b.x, c.x);
    const auto maxX = maxOf(a.x, b.x, c.x);
    const auto minY = minOf(a.y, b.y, c.y);
    const auto maxY = maxOf(a.y, b.y, c.y);
    const auto firstX = hn::ShiftRight<kSubpixelBits>(hn::Add(minX, round));
    const auto firstY = hn::ShiftRight<kSubpixelBits>(hn::Add(minY, round));
    const auto endX = hn::ShiftRight<kSubpixelBits>(hn::Add(maxX, subpixels));
    const auto endY = hn::ShiftRight<kSubpixelBits>(hn::Add(maxY, subpixels));
    ExtentLanes result;
    result.within = {
        hn::Max(firstX, hn::Zero(kInts)),
        hn::Max(firstY, hn::Zero(kInts)),
        hn::Sub(hn::Min(endX, hn::Set(kInts, tile.width())), one),
        hn::Sub(hn::Min(endY, hn::Set(kInts, tile.height())), one)};
    result.overlaps =
        hn::Not(hn::Or(hn::Gt(result.within.x0, result.within.x1), hn::Gt(result.within.y0, result.within.y1)));
    const auto pixels = hn::Max(hn::Sub(endX, firstX), hn::Sub(endY, firstY));
    const auto extent = hn::Max(hn::Sub(maxX, minX), hn::Sub(maxY, minY));
    result.isTiny = hn::Lt(pixels, hn::Set(kInts, 3));
    result.isSmall = hn::Lt(pixels, hn::Set(kInts, 5));
    result.isNarrow = hn::Lt(extent, hn::Set(kInts, kNarrowExtent));
    return result;
}

/// Returns a mask of the triangles that overlap the tile but are hidden by its drawn pixels.
HWY_INLINE IntMask
isHidden(const SnappedCluster& cluster, Ints corners, const ExtentLanes& extent, VisibilityTile& target) {
    const auto nearest = nearnessLanes(cluster, corners);
    const auto small = hn::And(extent.overlaps, hn::AndNot(extent.isTiny, extent.isSmall));
    const auto large = hn::AndNot(extent.isSmall, extent.overlaps);
    const auto hidden = hn::Or(
        isHiddenAtPixels(hn::And(extent.overlaps, extent.isTiny), 2, extent.within, nearest, target),
        isHiddenAtPixels(small, 4, extent.within, nearest, target));
    if (hn::AllFalse(kInts, large)) return hidden;
    return hn::Or(hidden, isHiddenInBlocks(large, extent.within, nearest, target));
}

} // namespace gnomon::raster::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
