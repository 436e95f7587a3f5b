// The results of SIMD triangle setup, stored in memory. The triangles are then drawn one after another, with one pixel
// per SIMD lane. The header is compiled once per SIMD instruction set.
#if defined(GNOMON_RASTER_STORED_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RASTER_STORED_LANES_INL_H
#undef GNOMON_RASTER_STORED_LANES_INL_H
#else
#define GNOMON_RASTER_STORED_LANES_INL_H
#endif

#include "raster/triangle_lanes-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The results of triangle setup in memory, for one triangle per SIMD lane.
struct StoredLanes {
    template <class T>
    using Lanes = std::array<T, kMaxLanes>;

    alignas(64) std::array<Lanes<std::int32_t>, 3> edges;
    alignas(64) std::array<Lanes<std::int32_t>, 3> perX;
    alignas(64) std::array<Lanes<std::int32_t>, 3> perY;
    alignas(64) std::array<Lanes<float>, 7> depth;      // the members of DepthLanes
    alignas(64) std::array<Lanes<std::int32_t>, 4> box; // range of pixels in the tile: first x, first y, last x, last y
    alignas(64) Lanes<std::int32_t> hasArea;
    alignas(64) Lanes<std::uint32_t> ids;

    static HWY_INLINE void store(const Edges& from, std::array<Lanes<std::int32_t>, 3>& to) {
        hn::Store(from.e0, kInts, to[0].data());
        hn::Store(from.e1, kInts, to[1].data());
        hn::Store(from.e2, kInts, to[2].data());
    }

    HWY_INLINE void take(const TriangleLanes& t) {
        store(t.edges, edges);
        store(t.perX, perX);
        store(t.perY, perY);
        hn::Store(t.depth.atReference, kFloats, depth[0].data());
        hn::Store(t.depth.perX, kFloats, depth[1].data());
        hn::Store(t.depth.perY, kFloats, depth[2].data());
        hn::Store(t.depth.min, kFloats, depth[3].data());
        hn::Store(t.depth.max, kFloats, depth[4].data());
        hn::Store(t.depth.fromX, kFloats, depth[5].data());
        hn::Store(t.depth.fromY, kFloats, depth[6].data());
        hn::Store(t.firstX, kInts, box[0].data());
        hn::Store(t.firstY, kInts, box[1].data());
        hn::Store(t.lastX, kInts, box[2].data());
        hn::Store(t.lastY, kInts, box[3].data());
        hn::Store(hn::VecFromMask(kInts, t.hasArea), kInts, hasArea.data());
    }
};

HWY_INLINE Ints along(std::int32_t first, std::int32_t perX) {
    return hn::Add(hn::Set(kInts, first), hn::Mul(hn::Iota(kInts, 0), hn::Set(kInts, perX)));
}

/// Adds the number of pixels that are set in the mask `inside` to the pixel count of `target`. The pixels begin at
/// column `x`. If `reachesOver` is true, pixels beyond the triangle's last column are not counted.
template <class Target>
HWY_INLINE void countInside(
    const StoredLanes& s, std::uint32_t lane, IntMask inside, std::int32_t x, bool reachesOver, Target& target) {
    if constexpr (Target::kCounts) {
        const auto beforeEnd = hn::Lt(hn::Iota(kInts, x), hn::Set(kInts, s.box[2][lane] + 1));
        target.count(hn::CountTrue(kInts, reachesOver ? hn::And(inside, beforeEnd) : inside));
    }
}

/// Draws triangle `lane` of the stored triangles, with one pixel per SIMD lane. `reachesOver` is true if SIMD vectors
/// of pixels may extend beyond the right edge of the tile.
template <class Target>
HWY_INLINE void drawStored(const StoredLanes& s, std::uint32_t lane, bool reachesOver, Target& target) {
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(kInts));
    Edges row = {
        along(s.edges[0][lane], s.perX[0][lane]),
        along(s.edges[1][lane], s.perX[1][lane]),
        along(s.edges[2][lane], s.perX[2][lane])};
    const Edges perRow = {
        hn::Set(kInts, s.perY[0][lane]), hn::Set(kInts, s.perY[1][lane]), hn::Set(kInts, s.perY[2][lane])};
    const Edges perVector = {
        hn::Set(kInts, s.perX[0][lane] * lanes),
        hn::Set(kInts, s.perX[1][lane] * lanes),
        hn::Set(kInts, s.perX[2][lane] * lanes)};
    const DepthLanes depth = {
        hn::Set(kFloats, s.depth[0][lane]),
        hn::Set(kFloats, s.depth[1][lane]),
        hn::Set(kFloats, s.depth[2][lane]),
        hn::Set(kFloats, s.depth[3][lane]),
        hn::Set(kFloats, s.depth[4][lane]),
        hn::Set(kFloats, s.depth[5][lane]),
        hn::Set(kFloats, s.depth[6][lane])};
    const auto one = hn::Set(kFloats, 1.0F);
    const auto firstX = hn::Add(depth.fromX, hn::Iota(kFloats, 0));
    auto fromY = depth.fromY;
    for (std::int32_t y = s.box[1][lane]; y <= s.box[3][lane]; ++y) {
        Edges e = row;
        const auto rowDepth = depthOfRow(depth, fromY);
        auto fromX = firstX;
        for (std::int32_t x = s.box[0][lane]; x <= s.box[2][lane]; x += lanes) {
            const auto inside = isInside(e);
            if (!hn::AllFalse(kInts, inside)) {
                target.takeRow(y * kTileStride + x, inside, depthAt(depth, rowDepth, fromX), s.ids[lane]);
                countInside(s, lane, inside, x, reachesOver, target);
            }
            step(e, perVector);
            fromX = hn::Add(fromX, hn::Set(kFloats, static_cast<float>(lanes)));
        }
        step(row, perRow);
        fromY = hn::Add(fromY, one);
    }
}

} // namespace gnomon::raster::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
