// A triangle in each vector lane: its edge functions and its plane of depth. Included once for each instruction set.
#if defined(GNOMON_RASTER_TRIANGLE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RASTER_TRIANGLE_LANES_INL_H
#undef GNOMON_RASTER_TRIANGLE_LANES_INL_H
#else
#define GNOMON_RASTER_TRIANGLE_LANES_INL_H
#endif

#include "raster/tile_kernel.h"
#include "raster/vertex_kernel.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using IntTag = hn::CappedTag<std::int32_t, kMostLanes>;
using UintTag = hn::RebindToUnsigned<IntTag>;
using FloatTag = hn::RebindToFloat<IntTag>;
using Ints = hn::Vec<IntTag>;
using Floats = hn::Vec<FloatTag>;
using IntMask = hn::Mask<IntTag>;

#if HWY_TARGET == HWY_SCALAR
using WordTag = hn::ScalableTag<std::uint64_t>;
#else
using WordTag = hn::Repartition<std::uint64_t, UintTag>;
#endif

constexpr IntTag kInts;
constexpr UintTag kUints;
constexpr FloatTag kFloats;

HWY_INLINE Ints least(Ints a, Ints b, Ints c) {
    return hn::Min(hn::Min(a, b), c);
}

HWY_INLINE Ints largest(Ints a, Ints b, Ints c) {
    return hn::Max(hn::Max(a, b), c);
}

/// The index of corner `i` in a packed triangle.
template <int i>
HWY_INLINE Ints cornerIndex(Ints packed) {
    const auto shifted = hn::ShiftRight<8 * i>(hn::BitCast(kUints, packed));
    return hn::BitCast(kInts, hn::And(shifted, hn::Set(kUints, 0xFFU)));
}

HWY_INLINE Ints triangleIds(const SnappedCluster& cluster, Ints packed) {
    const auto place = hn::BitCast(kInts, hn::ShiftRight<24>(hn::BitCast(kUints, packed)));
    if (cluster.triangleIds != nullptr)
        return hn::GatherIndex(kInts, reinterpret_cast<const std::int32_t*>(cluster.triangleIds), place);
    return hn::Add(place, hn::Set(kInts, static_cast<std::int32_t>(cluster.firstTriangleId)));
}

/// Edge functions at a pixel centre: twice the signed area of the pixel with each edge, in squared subpixels, less one
/// where the edge is neither left nor lowest, so that inside is where none is negative.
struct Edges {
    Ints e0, e1, e2; // opposite to corner 0, 1, 2
};

HWY_INLINE void step(Edges& edges, const Edges& by) {
    edges.e0 = hn::Add(edges.e0, by.e0);
    edges.e1 = hn::Add(edges.e1, by.e1);
    edges.e2 = hn::Add(edges.e2, by.e2);
}

HWY_INLINE IntMask isInside(const Edges& e) {
    return hn::Gt(hn::Or(hn::Or(e.e0, e.e1), e.e2), hn::Set(kInts, -1));
}

/// The plane of depth, through the corners as they were before snapping; a pixel inside never leaves the range of the
/// corners, nor 0 to 1. The reference is the pixel of corner 0, which depends on nothing but the triangle.
struct DepthLanes {
    Floats atReference, perX, perY; // per pixel
    Floats least, largest;
    Floats fromX, fromY; // the first pixel, from the reference
};

/// Of a row `fromY` pixels above the reference, before `depthAt` adds what lies along it.
HWY_INLINE Floats depthOfRow(const DepthLanes& d, Floats fromY) {
    return hn::Add(d.atReference, hn::Mul(d.perY, fromY));
}

HWY_INLINE Floats depthAt(const DepthLanes& d, Floats rowDepth, Floats fromX) {
    return hn::Min(hn::Max(hn::Add(rowDepth, hn::Mul(d.perX, fromX)), d.least), d.largest);
}

struct TriangleLanes {
    Edges edges; // at the first pixel
    Edges perX;
    Edges perY;
    DepthLanes depth;
    Ints firstX, firstY; // of the pixels between the extremes, in the tile
    Ints lastX, lastY;
    IntMask hasArea;
};

struct PointLanes {
    Ints x, y;
};

/// The edge from a to b at the pixel centre p.
HWY_INLINE void setEdge(
    const PointLanes& a, const PointLanes& b, const PointLanes& p, Ints& e, Ints& perX, Ints& perY) {
    const auto dx = hn::Sub(b.x, a.x);
    const auto dy = hn::Sub(b.y, a.y);
    const auto zero = hn::Zero(kInts);
    const auto ownsEdge = hn::Or(hn::Lt(dy, zero), hn::And(hn::Eq(dy, zero), hn::Gt(dx, zero)));
    const auto bias = hn::IfThenElse(ownsEdge, zero, hn::Set(kInts, -1));
    e = hn::Add(hn::Sub(hn::Mul(dx, hn::Sub(p.y, a.y)), hn::Mul(dy, hn::Sub(p.x, a.x))), bias);
    perX = hn::Neg(hn::ShiftLeft<kSubpixelBits>(dy));
    perY = hn::ShiftLeft<kSubpixelBits>(dx);
}

/// What snapping cut off each corner, in 1/256 pixel.
struct RestLanes {
    Floats x, y;
};

HWY_INLINE RestLanes restLanes(const SnappedCluster& cluster, Ints index) {
    const auto both = hn::GatherIndex(kInts, reinterpret_cast<const std::int32_t*>(cluster.vertices.rests), index);
    const auto scale = hn::Set(kFloats, 1.0F / (1 << kRestBits));
    return {
        hn::Mul(hn::ConvertTo(kFloats, hn::ShiftRight<16>(hn::ShiftLeft<16>(both))), scale),
        hn::Mul(hn::ConvertTo(kFloats, hn::ShiftRight<16>(both)), scale)};
}

/// An edge from corner 0, unsnapped where `isTrue`.
struct SideLanes {
    Floats snappedX, snappedY;
    Floats restX, restY;

    HWY_INLINE SideLanes(const PointLanes& from, const PointLanes& to, const RestLanes& fromRest, const RestLanes& rest)
        : snappedX(hn::ConvertTo(kFloats, hn::Sub(to.x, from.x))),
          snappedY(hn::ConvertTo(kFloats, hn::Sub(to.y, from.y))),
          restX(hn::Sub(rest.x, fromRest.x)),
          restY(hn::Sub(rest.y, fromRest.y)) {}

    HWY_INLINE Floats x() const { return hn::Add(snappedX, restX); }

    HWY_INLINE Floats y() const { return hn::Add(snappedY, restY); }

    HWY_INLINE void keepRestWhere(hn::Mask<FloatTag> isTrue) {
        restX = hn::IfThenElseZero(isTrue, restX);
        restY = hn::IfThenElseZero(isTrue, restY);
    }
};

HWY_INLINE Floats withinUnit(Floats z) {
    return hn::Min(hn::Max(z, hn::Zero(kFloats)), hn::Set(kFloats, 1.0F));
}

/// Loads corners of a cluster's triangles, relative to the lower left pixel centre of a tile.
template <bool isCompact>
class CornerSource {
public:
    HWY_INLINE CornerSource(const SnappedCluster& cluster, const PixelBox& tile)
        : cluster_(cluster),
          originX_(hn::Set(kInts, origin(cluster.box.x0, tile.x0))),
          originY_(hn::Set(kInts, origin(cluster.box.y0, tile.y0))) {}

    HWY_INLINE PointLanes operator()(Ints index) const {
        const auto x = hn::GatherIndex(kInts, cluster_.vertices.x, index);
        if constexpr (isCompact)
            return {hn::Add(hn::And(x, hn::Set(kInts, 0xFFFF)), originX_), hn::Add(high(x), originY_)};
        else
            return {hn::Add(x, originX_), hn::Add(hn::GatherIndex(kInts, cluster_.vertices.y, index), originY_)};
    }

private:
    static constexpr int origin(int first, int tileFirst) {
        return (isCompact ? first - 1 - tileFirst : -tileFirst) * kSubpixels;
    }

    static HWY_INLINE Ints high(Ints x) { return hn::BitCast(kInts, hn::ShiftRight<16>(hn::BitCast(kUints, x))); }

    const SnappedCluster& cluster_;
    Ints originX_;
    Ints originY_;
};

struct CornerDepths {
    Floats z0, z1, z2;
};

/// Sets the plane of depth of `t`, whose first pixel is set, from corner 0 and the sides to the others.
// NOLINTNEXTLINE(readability-function-size): a struct of these would be put together once and taken apart at once.
HWY_INLINE void setDepth(
    const PointLanes& a,
    RestLanes rest,
    SideLanes& side1,
    SideLanes& side2,
    Floats area,
    const CornerDepths& z,
    TriangleLanes& t) {
    const auto change = hn::Add(
        hn::Sub(hn::Mul(side1.snappedX, side2.restY), hn::Mul(side2.snappedX, side1.restY)),
        hn::Sub(hn::Mul(side1.restX, side2.y()), hn::Mul(side2.restX, side1.y())));
    // A sliver that snapping made: without it there would be no plane.
    const auto isTrue = hn::Gt(hn::Add(area, change), hn::Mul(area, hn::Set(kFloats, kLeastTrueArea)));
    side1.keepRestWhere(isTrue);
    side2.keepRestWhere(isTrue);
    rest = {hn::IfThenElseZero(isTrue, rest.x), hn::IfThenElseZero(isTrue, rest.y)};
    const auto inverseArea = hn::Div(hn::Set(kFloats, 1.0F), hn::Add(area, hn::IfThenElseZero(isTrue, change)));
    const auto dz1 = hn::Sub(z.z1, z.z0);
    const auto dz2 = hn::Sub(z.z2, z.z0);
    const auto perX = hn::Mul(hn::Sub(hn::Mul(dz1, side2.y()), hn::Mul(dz2, side1.y())), inverseArea);
    const auto perY = hn::Mul(hn::Sub(hn::Mul(dz2, side1.x()), hn::Mul(dz1, side2.x())), inverseArea);
    const auto referenceX = hn::ShiftRight<kSubpixelBits>(a.x);
    const auto referenceY = hn::ShiftRight<kSubpixelBits>(a.y);
    const auto toReference = [](Ints reference, Ints corner, Floats cornerRest) HWY_ATTR {
        const auto snapped = hn::ConvertTo(kFloats, hn::Sub(hn::ShiftLeft<kSubpixelBits>(reference), corner));
        return hn::Sub(snapped, cornerRest);
    };
    DepthLanes& depth = t.depth;
    depth.atReference = hn::Add(
        hn::Add(z.z0, hn::Mul(perX, toReference(referenceX, a.x, rest.x))),
        hn::Mul(perY, toReference(referenceY, a.y, rest.y)));
    const auto subpixels = hn::Set(kFloats, static_cast<float>(kSubpixels));
    depth.perX = hn::Mul(perX, subpixels);
    depth.perY = hn::Mul(perY, subpixels);
    depth.least = withinUnit(hn::Min(hn::Min(z.z0, z.z1), z.z2));
    depth.largest = withinUnit(hn::Max(hn::Max(z.z0, z.z1), z.z2));
    depth.fromX = hn::ConvertTo(kFloats, hn::Sub(t.firstX, referenceX));
    depth.fromY = hn::ConvertTo(kFloats, hn::Sub(t.firstY, referenceY));
}

/// Sets up a narrow triangle in each lane, turned counter-clockwise. Every pixel between its extremes and a vector
/// further fits an int32 edge function.
template <bool isCompact>
HWY_INLINE TriangleLanes triangleLanes(const SnappedCluster& cluster, Ints packed, const PixelBox& tile) {
    const CornerSource<isCompact> cornerAt(cluster, tile);
    const auto i0 = cornerIndex<0>(packed);
    auto i1 = cornerIndex<1>(packed);
    auto i2 = cornerIndex<2>(packed);
    const PointLanes a = cornerAt(i0);
    PointLanes b = cornerAt(i1);
    PointLanes c = cornerAt(i2);
    auto area = hn::Sub(hn::Mul(hn::Sub(b.x, a.x), hn::Sub(c.y, a.y)), hn::Mul(hn::Sub(c.x, a.x), hn::Sub(b.y, a.y)));
    const auto turned = hn::Lt(area, hn::Zero(kInts));
    area = hn::Abs(area);
    const PointLanes oldB = b;
    b = {hn::IfThenElse(turned, c.x, b.x), hn::IfThenElse(turned, c.y, b.y)};
    c = {hn::IfThenElse(turned, oldB.x, c.x), hn::IfThenElse(turned, oldB.y, c.y)};
    const auto oldI1 = i1;
    i1 = hn::IfThenElse(turned, i2, i1);
    i2 = hn::IfThenElse(turned, oldI1, i2);

    TriangleLanes t;
    t.hasArea = hn::Gt(area, hn::Zero(kInts));
    const auto round = hn::Set(kInts, kSubpixels - 1);
    t.firstX = hn::Max(hn::ShiftRight<kSubpixelBits>(hn::Add(least(a.x, b.x, c.x), round)), hn::Zero(kInts));
    t.firstY = hn::Max(hn::ShiftRight<kSubpixelBits>(hn::Add(least(a.y, b.y, c.y), round)), hn::Zero(kInts));
    t.lastX = hn::Min(hn::ShiftRight<kSubpixelBits>(largest(a.x, b.x, c.x)), hn::Set(kInts, tile.width() - 1));
    t.lastY = hn::Min(hn::ShiftRight<kSubpixelBits>(largest(a.y, b.y, c.y)), hn::Set(kInts, tile.height() - 1));
    const PointLanes pixel = {hn::ShiftLeft<kSubpixelBits>(t.firstX), hn::ShiftLeft<kSubpixelBits>(t.firstY)};
    setEdge(b, c, pixel, t.edges.e0, t.perX.e0, t.perY.e0);
    setEdge(c, a, pixel, t.edges.e1, t.perX.e1, t.perY.e1);
    setEdge(a, b, pixel, t.edges.e2, t.perX.e2, t.perY.e2);

    RestLanes rest = restLanes(cluster, i0);
    SideLanes side1(a, b, rest, restLanes(cluster, i1));
    SideLanes side2(a, c, rest, restLanes(cluster, i2));
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
    return t;
}

/// Pixels that triangles of a vector cover: place in the tile, depth, and name.
struct Hits { // NOLINT(cppcoreguidelines-pro-type-member-init): filled up to its count
    static constexpr std::size_t kMost =
        std::size_t{17} * kMostLanes; // 4 x 4 pixels of every lane, and a vector's overrun
    std::array<std::int32_t, kMost> addresses;
    std::array<float, kMost> depths;
    std::array<std::uint32_t, kMost> ids;
    std::size_t count = 0;

    template <bool hasIds>
    HWY_INLINE void add(IntMask inside, Ints address, Floats depth, Ints id) {
        hn::StoreU(hn::Compress(address, inside), kInts, addresses.data() + count);
        hn::StoreU(hn::Compress(depth, hn::RebindMask(kFloats, inside)), kFloats, depths.data() + count);
        if constexpr (hasIds) hn::StoreU(hn::BitCast(kUints, hn::Compress(id, inside)), kUints, ids.data() + count);
        count += hn::CountTrue(kInts, inside);
    }
};

/// A vector of set-up triangles laid down in memory, to be drawn one at a time.
struct StoredLanes {
    template <class T>
    using Lanes = std::array<T, kMostLanes>;

    alignas(64) std::array<Lanes<std::int32_t>, 3> edges;
    alignas(64) std::array<Lanes<std::int32_t>, 3> perX;
    alignas(64) std::array<Lanes<std::int32_t>, 3> perY;
    alignas(64) std::array<Lanes<float>, 7> depth;      // as in DepthLanes
    alignas(64) std::array<Lanes<std::int32_t>, 4> box; // first x, first y, last x, last y
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
        hn::Store(t.depth.least, kFloats, depth[3].data());
        hn::Store(t.depth.largest, kFloats, depth[4].data());
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

/// Draws the triangle of one lane, a vector of pixels at a time; `reachesOver` says if it may into the tile's margin.
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
                if constexpr (Target::kCounts) {
                    const auto beforeEnd = hn::Lt(hn::Iota(kInts, x), hn::Set(kInts, s.box[2][lane] + 1));
                    target.count(hn::CountTrue(kInts, reachesOver ? hn::And(inside, beforeEnd) : inside));
                }
            }
            step(e, perVector);
            fromX = hn::Add(fromX, hn::Set(kFloats, static_cast<float>(lanes)));
        }
        step(row, perRow);
        fromY = hn::Add(fromY, one);
    }
}

/// The memory of a tile of a depth map: the least depth stays.
struct DepthTile {
    static constexpr bool kHasIds = false;
    static constexpr bool kCounts = true; // pixels covered within the tile, each triangle's
    float* depths;
    std::uint64_t covered = 0;

    HWY_INLINE void count(std::size_t pixels) { covered += pixels; }

    HWY_INLINE void discount(std::size_t pixels) { covered -= pixels; }

    HWY_INLINE void takeHits(const Hits& hits) const {
        for (std::size_t i = 0; i < hits.count; ++i) {
            float& depth = depths[hits.addresses[i]];
            depth = std::min(depth, hits.depths[i]);
        }
    }

    HWY_INLINE void takeRow(int address, IntMask inside, Floats depth, std::uint32_t /*id*/) const {
        const auto old = hn::LoadU(kFloats, depths + address);
        const auto nearer = hn::Min(old, depth);
        hn::StoreU(hn::IfThenElse(hn::RebindMask(kFloats, inside), nearer, old), kFloats, depths + address);
    }
};

/// The memory of a tile of a visibility buffer: the largest word stays.
struct VisibilityTile {
    static constexpr bool kHasIds = true;
    static constexpr bool kCounts = false;
    std::uint64_t* words;

    HWY_INLINE void takeHits(const Hits& hits) const {
        for (std::size_t i = 0; i < hits.count; ++i) {
            std::uint64_t& word = words[hits.addresses[i]];
            word = std::max(word, visibilityWord(hits.depths[i], hits.ids[i]));
        }
    }

    HWY_INLINE void takeRow(int address, IntMask inside, Floats depth, std::uint32_t id) const {
        // A word of 0 is less than any, so it stands for the pixels outside.
        const auto mask = hn::RebindMask(kUints, inside);
        const auto high = hn::IfThenElseZero(mask, hn::BitCast(kUints, depth));
        const auto low = hn::IfThenElseZero(mask, hn::Set(kUints, ~id));
        constexpr WordTag kWords;
#if HWY_TARGET == HWY_SCALAR // one lane has no halves
        takeWords(address, hn::PromoteTo(kWords, high), hn::PromoteTo(kWords, low));
#else
        const hn::Half<UintTag> half;
        takeWords(
            address, hn::PromoteTo(kWords, hn::LowerHalf(half, high)), hn::PromoteTo(kWords, hn::LowerHalf(half, low)));
        takeWords(
            address + static_cast<int>(hn::Lanes(kWords)),
            hn::PromoteTo(kWords, hn::UpperHalf(half, high)),
            hn::PromoteTo(kWords, hn::UpperHalf(half, low)));
#endif
    }

private:
    template <class Words>
    HWY_INLINE void takeWords(int address, Words high, Words low) const {
        constexpr WordTag kWords;
        const auto word = hn::Or(hn::ShiftLeft<32>(high), low);
        hn::StoreU(hn::Max(hn::LoadU(kWords, words + address), word), kWords, words + address);
    }
};

} // namespace gnomon::raster::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
