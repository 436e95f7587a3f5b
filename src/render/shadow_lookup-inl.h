// Shadow map lookups with one surface point per SIMD lane: selects the map and computes the lit fraction. Included
// once per instruction set.
#if defined(GNOMON_RENDER_SHADOW_LOOKUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RENDER_SHADOW_LOOKUP_INL_H
#undef GNOMON_RENDER_SHADOW_LOOKUP_INL_H
#else
#define GNOMON_RENDER_SHADOW_LOOKUP_INL_H
#endif

#include "render/shading_batch.h"
#include "render/vector_lanes-inl.h"

#include <algorithm>
#include <cstddef>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::render::HWY_NAMESPACE {

HWY_INLINE Ints sliceOf(const ShadingFrame& f, Floats z) {
    auto slice = hn::Zero(kInts);
    for (int s = 0; s + 1 < f.frame->sliceCount; ++s) {
        const auto isBehind = hn::RebindMask(kInts, hn::Ge(z, constant(f.shadows->slices[s].far)));
        slice = hn::IfThenElse(isBehind, hn::Set(kInts, s + 1), slice);
    }
    return slice;
}

/// Returns the index of the face partition (the part of the view at one side of the frustum) that contains `p`. `p` is
/// a position relative to the eye, in slice `slice`.
HWY_INLINE Ints faceOf(const ShadingFrame& f, const Vec3& p, Ints slice) {
    const block::Shadows& shadows = *f.shadows;
    const auto zero = hn::Zero(kFloats);
    const int faces = f.frame->sideFaceCount;
    auto face = hn::Set(kInts, faces - 1);
    for (int i = faces - 2; i >= 0; --i) {
        const auto first = hn::Ge(dot(constant(&shadows.faceFirst[i].x), p), zero);
        const auto second = hn::Ge(dot(constant(&shadows.faceSecond[i].x), p), zero);
        face = hn::IfThenElse(hn::RebindMask(kInts, hn::And(first, second)), hn::Set(kInts, i), face);
    }
    if (f.frame->hasOwnNear != 1) return face;
    const auto edge = [&](int k) HWY_ATTR {
        return hn::GatherIndex(kFloats, &shadows.faceEdge[0].x + k, hn::ShiftLeft<2>(face));
    };
    const auto sliceNear = hn::GatherIndex(kFloats, &shadows.slices[0].near, hn::ShiftLeft<2>(slice));
    const auto inNear = hn::Lt(dot({edge(0), edge(1), edge(2)}, p), hn::Mul(edge(3), sliceNear));
    return hn::IfThenElse(hn::RebindMask(kInts, inNear), hn::Set(kInts, faces), face);
}

HWY_INLINE Ints passOf(const ShadingFrame& f, const Vec3& p, Floats z) {
    const auto slice = sliceOf(f, z);
    const int facesPerSlice = std::max(f.frame->sideFaceCount, 1) + f.frame->hasOwnNear;
    auto index = hn::Mul(slice, hn::Set(kInts, facesPerSlice));
    if (f.frame->sideFaceCount != 0) index = hn::Add(index, faceOf(f, p, slice));
    return hn::GatherIndex(kInts, &f.shadows->passOfPartition[0].x, index);
}

constexpr int kPartitionFloats = sizeof(block::Partition) / sizeof(float);
/// The index of the first float of a member of block::Partition, if the struct is read as an array of floats.
#define GNOMON_PARTITION_FLOAT(member) (offsetof(block::Partition, member) / sizeof(float))
constexpr int kOrigin = GNOMON_PARTITION_FLOAT(origin);
constexpr int kReach = GNOMON_PARTITION_FLOAT(reach);
constexpr int kTexelScale = GNOMON_PARTITION_FLOAT(texelScale);
constexpr int kTexelOffset = GNOMON_PARTITION_FLOAT(texelOffset);
constexpr int kByColumn = GNOMON_PARTITION_FLOAT(byColumn);
constexpr int kByRow = GNOMON_PARTITION_FLOAT(byRow);
constexpr int kByDepth = GNOMON_PARTITION_FLOAT(byDepth);
constexpr int kUnevenX = GNOMON_PARTITION_FLOAT(unevenX);
constexpr int kUnevenZ = GNOMON_PARTITION_FLOAT(unevenZ);
constexpr int kFirstTexel = GNOMON_PARTITION_FLOAT(firstTexel);
constexpr int kEndTexel = GNOMON_PARTITION_FLOAT(endTexel);
constexpr int kLogRows = GNOMON_PARTITION_FLOAT(logRows);
#undef GNOMON_PARTITION_FLOAT
static_assert(offsetof(block::Partition, clipFromOffset) == 0);

/// The shadow map parameters of one point per SIMD lane. With isUniform, all lanes use the same map.
template <bool isUniform>
class PartitionLanes {
public:
    HWY_INLINE PartitionLanes(const ShadingFrame& f, Ints pass)
        : base_(&f.shadows->partitions[isUniform ? hn::GetLane(pass) : 0].clipFromOffset[0].x),
          offsets_(hn::Mul(pass, hn::Set(kInts, kPartitionFloats))) {}

    HWY_INLINE Floats operator()(int k) const {
        if constexpr (isUniform)
            return constant(base_[k]);
        else
            return hn::GatherIndex(kFloats, base_ + k, offsets_);
    }

private:
    const float* base_;
    Ints offsets_;
};

/// Returns clip-space coordinate `row` of a point in a shadow map. `offset` is the position of the point relative to
/// the map's origin.
template <class Partition>
HWY_INLINE Floats clipCoordinate(const Partition& part, int row, const Vec3& offset) {
    return hn::Add(
        hn::Add(hn::Mul(part(row), offset.x), hn::Mul(part(4 + row), offset.y)),
        hn::Add(hn::Mul(part(8 + row), offset.z), part(12 + row)));
}

/// Returns true if the shadow maps belong to a point light. They then have one partition per cube face.
HWY_INLINE bool isFromPoint(const ShadingFrame& f) {
    return f.frame->pointReach > 0;
}

/// Returns a mask of the SIMD lanes whose shadow map has logarithmic rows.
template <class Partition>
HWY_INLINE Mask hasLogRows(const Partition& part) {
    return hn::Gt(part(kLogRows), hn::Zero(kFloats));
}

/// The clip-space coordinate w of one point per SIMD lane, and 1 / w.
struct ClipW {
    Floats w, inverse;
};

/// Returns the depth bias for a receiver at `offset`: the change of depth over half a texel and the filter kernel. The
/// bias covers the receiver's plane, and a neighbouring surface that is steeper by kUnevenSlope.
template <class Partition>
HWY_INLINE Floats receiverBias(
    const ShadingFrame& f,
    const Partition& part,
    const Vec3& offset,
    const Vec3& normal,
    Floats cosine,
    const ClipW& clip) {
    const auto distance = hn::Neg(dot(normal, offset));
    const auto withPlane = [&](int k) HWY_ATTR {
        return hn::Add(dot(normal, {part(k), part(k + 1), part(k + 2)}), hn::Mul(distance, part(k + 3)));
    };
    const auto across = hn::Max(hn::Abs(withPlane(kByDepth)), constant(1e-30F));
    const auto isLog = hasLogRows(part);
    const auto one = constant(1);
    const auto byRow = hn::Mul(hn::Abs(withPlane(kByRow)), hn::IfThenElse(isLog, clip.inverse, one));
    const auto slope = hn::Div(hn::Add(hn::Abs(withPlane(kByColumn)), byRow), across);
    const auto grazing = hn::Min(constant(1), hn::Mul(cosine, constant(10)));
    const auto unevenX = part(kUnevenX);
    const bool isPoint = isFromPoint(f);
    const auto unevenZ = isPoint ? part(kUnevenZ) : hn::Mul(part(kUnevenZ), hn::IfThenElse(isLog, one, clip.w));
    auto uneven = hn::Sqrt(hn::Add(hn::Mul(unevenX, unevenX), hn::Mul(unevenZ, unevenZ)));
    if (isPoint) uneven = hn::Mul(uneven, clip.inverse);
    return hn::Add(hn::Mul(hn::Add(hn::Mul(slope, grazing), uneven), part(kReach)), constant(6e-7F));
}

/// Returns the coordinate that determines the row in the shadow map: y / w, or ln w for logarithmic rows.
template <class Partition>
HWY_INLINE Floats alongRows(const Partition& part, Floats yOverW, Floats w) {
    const auto isLog = hasLogRows(part);
    if (hn::AllFalse(kFloats, isLog)) return yOverW;
    const auto logarithm = naturalLog(hn::Max(w, constant(1e-30F)));
    return hn::IfThenElse(isLog, logarithm, yOverW);
}

HWY_INLINE Floats between(Floats a, Floats b, Floats fraction) {
    return hn::Add(a, hn::Mul(fraction, hn::Sub(b, a)));
}

/// The parameters of one shadow map lookup per SIMD lane. The filter kernel is a square of texels that starts at the
/// floor of `startX` and `startY` and is clamped to the partition. `depth` is compared with the stored depths.
struct LookupLanes {
    Floats startX, startY, depth;
};

template <class Partition>
HWY_INLINE LookupLanes
lookupAt(const ShadingFrame& f, const Partition& part, const Vec3& p, const Vec3& normal, Floats cosine) {
    const Vec3 offset = subtract(p, {part(kOrigin), part(kOrigin + 1), part(kOrigin + 2)});
    const auto w = clipCoordinate(part, 3, offset);
    // No receiver should be in the plane w = 0 of its shadow map. This test prevents a NaN.
    const auto isFinite = hn::Gt(hn::Abs(w), constant(1e-30F));
    const auto inverseW = inverse(hn::IfThenElse(isFinite, w, constant(1e-30F)));
    const auto texelOf = [&](int row) HWY_ATTR {
        auto clip = hn::Mul(clipCoordinate(part, row, offset), inverseW);
        if (row == 1) clip = alongRows(part, clip, w);
        return hn::Add(hn::Mul(clip, part(kTexelScale + row)), part(kTexelOffset + row));
    };
    // The depth is clamped to 1, the far end of the depth range. For a receiver beyond this end, all its casters are
    // in the map.
    const auto depth = hn::Min(
        hn::Sub(
            hn::Mul(clipCoordinate(part, 2, offset), inverseW),
            receiverBias(f, part, offset, normal, cosine, {w, inverseW})),
        constant(1));
    const auto half = constant(0.5F * static_cast<float>(std::max(f.frame->filterTexels, 1) - 1));
    const auto far = constant(1e6F);
    const auto startOf = [&](Floats texel)
                             HWY_ATTR { return hn::Min(hn::Max(hn::Sub(texel, half), hn::Neg(far)), far); };
    return {startOf(texelOf(0)), startOf(texelOf(1)), depth};
}

template <bool isUniform>
HWY_INLINE Floats litFraction(const ShadingFrame& f, Ints pass, const Vec3& p, const Vec3& normal, Floats cosine) {
    const PartitionLanes<isUniform> part(f, pass);
    const auto [startX, startY, depth] = lookupAt(f, part, p, normal, cosine);
    const int width = std::max(f.frame->filterTexels, 1);
    const auto firstX = hn::ConvertTo(kInts, hn::Floor(startX));
    const auto firstY = hn::ConvertTo(kInts, hn::Floor(startY));
    const auto fractionX = hn::Sub(startX, hn::Floor(startX));
    const auto fractionY = hn::Sub(startY, hn::Floor(startY));
    const auto side = [&](int k) HWY_ATTR { return hn::ConvertTo(kInts, part(k)); };
    const auto one = hn::Set(kInts, 1);
    const auto lowX = side(kFirstTexel);
    const auto lowY = side(kFirstTexel + 1);
    const auto highX = hn::Sub(side(kEndTexel), one);
    const auto highY = hn::Sub(side(kEndTexel + 1), one);
    // The filter interpolates between two squares of texels that are one texel narrower than the kernel. The weight of
    // the outer texels is therefore a fraction, and a fully lit result is exactly 1.
    const int box = std::max(width - 1, 1);
    auto above = hn::Zero(kFloats);
    auto below = hn::Zero(kFloats);
    for (int y = 0; y < width; ++y) {
        const auto row = hn::Min(hn::Max(hn::Add(firstY, hn::Set(kInts, y)), lowY), highY);
        const auto start = hn::Mul(row, hn::Set(kInts, f.shadowWidth));
        auto left = hn::Zero(kFloats);
        auto right = hn::Zero(kFloats);
        for (int x = 0; x < width; ++x) {
            const auto column = hn::Min(hn::Max(hn::Add(firstX, hn::Set(kInts, x)), lowX), highX);
            const auto stored = hn::GatherIndex(kFloats, f.shadowDepth, hn::Add(start, column));
            const auto isLit = hn::IfThenElseZero(hn::Le(depth, stored), constant(1));
            if (x < box) left = hn::Add(left, isLit);
            if (x >= width - box) right = hn::Add(right, isLit);
        }
        const auto ofRow = between(left, right, fractionX);
        if (y < box) above = hn::Add(above, ofRow);
        if (y >= width - box) below = hn::Add(below, ofRow);
    }
    return hn::Div(between(above, below, fractionY), constant(static_cast<float>(box * box)));
}

/// A visible surface point per SIMD lane.
struct SurfaceLanes {
    Vec3 position, normal;
    Floats depth;  // view depth
    Floats cosine; // cosine of the angle between normal and light
    Mask faces;    // true: the cosine is greater than 0
};

/// Returns the index of the shadow map whose cube face contains the direction `fromLight` from the point light.
HWY_INLINE Ints passOfCubeFace(const ShadingFrame& f, const Vec3& fromLight) {
    const auto x = hn::Abs(fromLight.x);
    const auto y = hn::Abs(fromLight.y);
    const auto z = hn::Abs(fromLight.z);
    const auto isX = hn::And(hn::Ge(x, y), hn::Ge(x, z));
    const auto isY = hn::Ge(y, z);
    const auto along = hn::IfThenElse(isX, fromLight.x, hn::IfThenElse(isY, fromLight.y, fromLight.z));
    const auto number = [&](int i) HWY_ATTR { return hn::Set(kInts, i); };
    const auto plus = hn::IfThenElse(
        hn::RebindMask(kInts, isX), number(0), hn::IfThenElse(hn::RebindMask(kInts, isY), number(2), number(4)));
    const auto isMinus = hn::RebindMask(kInts, hn::Lt(along, hn::Zero(kFloats)));
    const auto face = hn::Add(plus, hn::IfThenElse(isMinus, number(1), number(0)));
    return hn::GatherIndex(kInts, &f.shadows->passOfPartition[0].x, face);
}

/// Returns the index of the shadow map for each surface point. The index is -1 if there is no map or the surface faces
/// away from the light.
HWY_INLINE Ints passOfSurface(const ShadingFrame& f, const SurfaceLanes& surface) {
    const auto pass = isFromPoint(f) ? passOfCubeFace(f, subtract(surface.position, constant(&f.frame->towardsLight.x)))
                                     : passOf(f, subtract(surface.position, constant(&f.frame->eye.x)), surface.depth);
    return hn::IfThenElse(hn::RebindMask(kInts, surface.faces), pass, hn::Set(kInts, -1));
}

/// Returns the lit fraction of surface points that face the light, by lookups in the shadow maps. `pass` receives the
/// index of the map, or -1 for lanes without a lookup.
HWY_INLINE Floats litByMaps(const ShadingFrame& f, const SurfaceLanes& surface, Ints& pass) {
    const auto none = hn::Set(kInts, -1);
    pass = none;
    if (hn::AllFalse(kFloats, surface.faces)) return hn::Zero(kFloats);
    pass = passOfSurface(f, surface);
    const auto isRequested = hn::Gt(pass, none);
    auto lit = constant(1);
    if (!hn::AllFalse(kInts, isRequested)) {
        const auto largest = hn::MaxOfLanes(kInts, pass);
        const auto filled = hn::IfThenElse(isRequested, pass, largest);
        const auto asked = hn::AllTrue(kInts, hn::Eq(filled, largest))
                               ? litFraction<true>(f, filled, surface.position, surface.normal, surface.cosine)
                               : litFraction<false>(f, filled, surface.position, surface.normal, surface.cosine);
        lit = hn::IfThenElse(hn::RebindMask(kFloats, isRequested), asked, lit);
    }
    return hn::IfThenElseZero(surface.faces, lit);
}

/// The parameters of shadow map lookups that are done later, when the maps are drawn: ranges of texels within the
/// partition, and the depths to compare.
struct AwaitedLanes {
    Ints firstColumn = hn::Zero(kInts);
    Ints firstRow = hn::Zero(kInts);
    Ints lastColumn = hn::Zero(kInts);
    Ints lastRow = hn::Zero(kInts);
    Floats depth = hn::Zero(kFloats);
};

template <bool isUniform>
HWY_INLINE AwaitedLanes awaitedAt(const ShadingFrame& f, Ints pass, const SurfaceLanes& surface) {
    const PartitionLanes<isUniform> part(f, pass);
    const auto [startX, startY, depth] = lookupAt(f, part, surface.position, surface.normal, surface.cosine);
    const auto further = hn::Set(kInts, std::max(f.frame->filterTexels, 1) - 1);
    const auto within = [&](Ints texel, int axis) HWY_ATTR {
        const auto low = hn::ConvertTo(kInts, part(kFirstTexel + axis));
        const auto high = hn::Sub(hn::ConvertTo(kInts, part(kEndTexel + axis)), hn::Set(kInts, 1));
        return hn::Min(hn::Max(texel, low), high);
    };
    const auto column = hn::ConvertTo(kInts, hn::Floor(startX));
    const auto row = hn::ConvertTo(kInts, hn::Floor(startY));
    return {
        within(column, 0),
        within(row, 1),
        within(hn::Add(column, further), 0),
        within(hn::Add(row, further), 1),
        depth};
}

/// Returns the parameters of shadow map lookups that are done later, when the maps are drawn. `pass` receives the index
/// of the map, or -1 for lanes without a lookup, whose parameters are meaningless.
HWY_INLINE AwaitedLanes awaitedLookups(const ShadingFrame& f, const SurfaceLanes& surface, Ints& pass) {
    const auto none = hn::Set(kInts, -1);
    pass = none;
    if (hn::AllFalse(kFloats, surface.faces)) return {};
    pass = passOfSurface(f, surface);
    const auto isRequested = hn::Gt(pass, none);
    if (hn::AllFalse(kInts, isRequested)) return {};
    const auto largest = hn::MaxOfLanes(kInts, pass);
    const auto filled = hn::IfThenElse(isRequested, pass, largest);
    return hn::AllTrue(kInts, hn::Eq(filled, largest)) ? awaitedAt<true>(f, filled, surface)
                                                       : awaitedAt<false>(f, filled, surface);
}

} // namespace gnomon::render::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
