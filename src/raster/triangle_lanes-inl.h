// Triangle setup with one triangle per SIMD lane: edge functions and depth planes. The header is compiled once per
// SIMD instruction set.
#if defined(GNOMON_RASTER_TRIANGLE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RASTER_TRIANGLE_LANES_INL_H
#undef GNOMON_RASTER_TRIANGLE_LANES_INL_H
#else
#define GNOMON_RASTER_TRIANGLE_LANES_INL_H
#endif

#include "raster/tile_work.h"
#include "raster/vertex_kernel.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using IntTag = hn::CappedTag<std::int32_t, kMaxLanes>;
using UintTag = hn::RebindToUnsigned<IntTag>;
using FloatTag = hn::RebindToFloat<IntTag>;
using Ints = hn::Vec<IntTag>;
using Floats = hn::Vec<FloatTag>;
using IntMask = hn::Mask<IntTag>;

constexpr IntTag kInts;
constexpr UintTag kUints;
constexpr FloatTag kFloats;

HWY_INLINE Ints minOf(Ints a, Ints b, Ints c) {
    return hn::Min(hn::Min(a, b), c);
}

HWY_INLINE Ints maxOf(Ints a, Ints b, Ints c) {
    return hn::Max(hn::Max(a, b), c);
}

/// Returns the vertex index of corner `i` of one packed triangle per SIMD lane.
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

/// The edge functions of one triangle per SIMD lane, at a pixel centre. An edge function is twice the signed area of
/// the triangle between the edge and the pixel centre, in squared subpixels. The value is reduced by one if the edge is
/// neither a left edge nor the lowest edge. A pixel is inside the triangle if no edge function is negative.
struct Edges {
    Ints e0, e1, e2; // e0 belongs to the edge opposite corner 0, and so on
};

HWY_INLINE void step(Edges& edges, const Edges& by) {
    edges.e0 = hn::Add(edges.e0, by.e0);
    edges.e1 = hn::Add(edges.e1, by.e1);
    edges.e2 = hn::Add(edges.e2, by.e2);
}

HWY_INLINE IntMask isInside(const Edges& e) {
    return hn::Gt(hn::Or(hn::Or(e.e0, e.e1), e.e2), hn::Set(kInts, -1));
}

/// The depth plane of one triangle per SIMD lane, computed from the unsnapped corners. Pixel depths are clamped to the
/// depth range of the corners and to [0, 1]. The reference point is the pixel of corner 0, so it depends only on the
/// triangle.
struct DepthLanes {
    Floats atReference, perX, perY; // depth at the reference point, and its change per pixel
    Floats min, max;
    Floats fromX, fromY; // pixels from the reference point to the first pixel
};

/// Returns the depth at the reference column of the depth plane, `fromY` pixels above the reference point.
HWY_INLINE Floats depthOfRow(const DepthLanes& d, Floats fromY) {
    return hn::Add(d.atReference, hn::Mul(d.perY, fromY));
}

HWY_INLINE Floats depthAt(const DepthLanes& d, Floats rowDepth, Floats fromX) {
    return hn::Min(hn::Max(hn::Add(rowDepth, hn::Mul(d.perX, fromX)), d.min), d.max);
}

struct TriangleLanes {
    Edges edges; // edge functions at the first pixel
    Edges perX;
    Edges perY;
    DepthLanes depth;
    Ints firstX, firstY; // first pixel of the bounding box in the tile; lastX and lastY: last pixel
    Ints lastX, lastY;
    IntMask hasArea;
};

struct PointLanes {
    Ints x, y;
};

/// Computes the edge function `e` of the edge from `a` to `b` at the pixel centre `p`, and its increments per column
/// and row.
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

/// The snapping remainders of a triangle corner per SIMD lane: unsnapped minus snapped position, in 1/256 pixel.
struct RestLanes {
    Floats x, y;
};

HWY_INLINE RestLanes unpackedRests(Ints both) {
    const auto scale = hn::Set(kFloats, 1.0F / (1 << kRestBits));
    return {
        hn::Mul(hn::ConvertTo(kFloats, hn::ShiftRight<16>(hn::ShiftLeft<16>(both))), scale),
        hn::Mul(hn::ConvertTo(kFloats, hn::ShiftRight<16>(both)), scale)};
}

HWY_INLINE RestLanes restLanes(const SnappedCluster& cluster, Ints index) {
    return unpackedRests(hn::GatherIndex(kInts, reinterpret_cast<const std::int32_t*>(cluster.vertices.rests), index));
}

/// The edge vector from corner 0 to another corner of a triangle per SIMD lane, and its snapping remainder.
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

/// Loads the corners of a cluster's triangles, with one triangle per SIMD lane. Positions are relative to the centre of
/// the tile's lower left pixel.
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

/// Returns twice the area of each SIMD lane's triangle. Swaps corners 1 and 2 of clockwise triangles, so that the area
/// is positive.
HWY_INLINE Ints turnedArea(const PointLanes& a, PointLanes& b, PointLanes& c, Ints& i1, Ints& i2) {
    const auto area =
        hn::Sub(hn::Mul(hn::Sub(b.x, a.x), hn::Sub(c.y, a.y)), hn::Mul(hn::Sub(c.x, a.x), hn::Sub(b.y, a.y)));
    const auto isTurned = hn::Lt(area, hn::Zero(kInts));
    const auto swapTurned = [isTurned](Ints& p, Ints& q) HWY_ATTR {
        const auto old = p;
        p = hn::IfThenElse(isTurned, q, p);
        q = hn::IfThenElse(isTurned, old, q);
    };
    swapTurned(b.x, c.x);
    swapTurned(b.y, c.y);
    swapTurned(i1, i2);
    return hn::Abs(area);
}

struct CornerDepths {
    Floats z0, z1, z2;
};

HWY_INLINE CornerDepths cornerDepths(const SnappedCluster& cluster, Ints i0, Ints i1, Ints i2) {
    const float* z = cluster.vertices.z;
    return {hn::GatherIndex(kFloats, z, i0), hn::GatherIndex(kFloats, z, i1), hn::GatherIndex(kFloats, z, i2)};
}

/// Computes the depth plane of the triangles `t` from corner 0 and the edges to the other corners. The first pixel of
/// `t` must be set.
// NOLINTNEXTLINE(readability-function-size): a struct of these parameters would have one use.
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
    // The unsnapped corners of a thin triangle give no reliable depth plane if most of its area comes from snapping.
    const auto isTrue = hn::Gt(hn::Add(area, change), hn::Mul(area, hn::Set(kFloats, kMinTrueArea)));
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
    depth.min = withinUnit(hn::Min(hn::Min(z.z0, z.z1), z.z2));
    depth.max = withinUnit(hn::Max(hn::Max(z.z0, z.z1), z.z2));
    depth.fromX = hn::ConvertTo(kFloats, hn::Sub(t.firstX, referenceX));
    depth.fromY = hn::ConvertTo(kFloats, hn::Sub(t.firstY, referenceY));
}

/// Computes triangle setup for one narrow triangle per SIMD lane and returns the result. The corners are then
/// counter-clockwise. The edge functions fit an int32 at each pixel of the bounding box and one vector beyond it.
template <bool isCompact>
HWY_INLINE TriangleLanes triangleLanes(const SnappedCluster& cluster, Ints packed, const PixelBox& tile) {
    const CornerSource<isCompact> cornerAt(cluster, tile);
    const auto i0 = cornerIndex<0>(packed);
    auto i1 = cornerIndex<1>(packed);
    auto i2 = cornerIndex<2>(packed);
    const PointLanes a = cornerAt(i0);
    PointLanes b = cornerAt(i1);
    PointLanes c = cornerAt(i2);
    const auto area = turnedArea(a, b, c, i1, i2);

    TriangleLanes t;
    t.hasArea = hn::Gt(area, hn::Zero(kInts));
    const auto round = hn::Set(kInts, kSubpixels - 1);
    t.firstX = hn::Max(hn::ShiftRight<kSubpixelBits>(hn::Add(minOf(a.x, b.x, c.x), round)), hn::Zero(kInts));
    t.firstY = hn::Max(hn::ShiftRight<kSubpixelBits>(hn::Add(minOf(a.y, b.y, c.y), round)), hn::Zero(kInts));
    t.lastX = hn::Min(hn::ShiftRight<kSubpixelBits>(maxOf(a.x, b.x, c.x)), hn::Set(kInts, tile.width() - 1));
    t.lastY = hn::Min(hn::ShiftRight<kSubpixelBits>(maxOf(a.y, b.y, c.y)), hn::Set(kInts, tile.height() - 1));
    const PointLanes pixel = {hn::ShiftLeft<kSubpixelBits>(t.firstX), hn::ShiftLeft<kSubpixelBits>(t.firstY)};
    setEdge(b, c, pixel, t.edges.e0, t.perX.e0, t.perY.e0);
    setEdge(c, a, pixel, t.edges.e1, t.perX.e1, t.perY.e1);
    setEdge(a, b, pixel, t.edges.e2, t.perX.e2, t.perY.e2);

    RestLanes rest = restLanes(cluster, i0);
    SideLanes side1(a, b, rest, restLanes(cluster, i1));
    SideLanes side2(a, c, rest, restLanes(cluster, i2));
    setDepth(a, rest, side1, side2, hn::ConvertTo(kFloats, area), cornerDepths(cluster, i0, i1, i2), t);
    return t;
}

} // namespace gnomon::raster::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
