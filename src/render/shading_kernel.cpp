#include "render/shading_kernel.h"

#include <algorithm>
#include <cstddef>

// The order of includes matters, because foreach_target.h includes this file once per instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/shading_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "render/light/light_model-inl.h"
#include "render/shadow_lookup-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();

namespace gnomon::render::HWY_NAMESPACE {

template <class T>
HWY_INLINE auto load(const PixelBatch::Values<T>& values, std::size_t i) {
    return hn::LoadU(hn::Rebind<T, IntTag>(), values.data() + i);
}

template <class T>
HWY_INLINE Vec3 loadFloats(const PixelBatch::Vectors<T>& values, std::size_t i) {
    return {toFloats(load(values[0], i)), toFloats(load(values[1], i)), toFloats(load(values[2], i))};
}

HWY_INLINE Vec3 loadVec3(const PixelBatch::Vectors<float>& values, std::size_t i) {
    return {load(values[0], i), load(values[1], i), load(values[2], i)};
}

HWY_INLINE void store(const Vec3& v, PixelBatch::Vectors<float>& values, std::size_t i) {
    hn::StoreU(v.x, kFloats, values[0].data() + i);
    hn::StoreU(v.y, kFloats, values[1].data() + i);
    hn::StoreU(v.z, kFloats, values[2].data() + i);
}

/// The barycentric weights of a point in a triangle, per SIMD lane.
struct Weights {
    Floats first, second, third;

    HWY_INLINE Floats mix(Floats a, Floats b, Floats c) const {
        return hn::Add(hn::Add(hn::Mul(first, a), hn::Mul(second, b)), hn::Mul(third, c));
    }
};

/// The point of a triangle edge that is nearest to a ray, per SIMD lane.
struct NearestOnEdge {
    Floats along; // position on the edge, from 0 to 1
    // A measure of the distance between the point and the ray, times the squared length of the ray's direction. In
    // perspective, the measure is the squared sine of the angle to the ray. For parallel rays, it is the squared
    // distance.
    Floats beside;
};

HWY_INLINE NearestOnEdge nearestOnEdge(const Vec3& ray, bool isParallel, const Vec3& end, const Vec3& edge) {
    const auto tiny = constant(1e-30F);
    const Vec3 endBeside = cross(end, ray);
    const Vec3 edgeBeside = cross(edge, ray);
    const auto wanted = hn::Div(hn::Neg(dot(endBeside, edgeBeside)), hn::Max(dot(edgeBeside, edgeBeside), tiny));
    const auto along = hn::Min(hn::Max(wanted, hn::Zero(kFloats)), constant(1));
    const Vec3 point = add(end, scale(edge, along));
    const Vec3 beside = add(endBeside, scale(edgeBeside, along));
    if (isParallel) return {along, dot(beside, beside)};
    return {along, hn::Div(dot(beside, beside), hn::Max(dot(point, point), tiny))};
}

/// Returns the barycentric weights of the point on the triangle's outline that is nearest to the ray.
HWY_INLINE Weights
nearestOnOutline(const Vec3& ray, bool isParallel, const Vec3& fromCorner, const Vec3& e1, const Vec3& e2) {
    const auto zero = hn::Zero(kFloats);
    const auto one = constant(1);
    const Vec3 corner = {hn::Neg(fromCorner.x), hn::Neg(fromCorner.y), hn::Neg(fromCorner.z)};
    const NearestOnEdge first = nearestOnEdge(ray, isParallel, corner, e1);
    const NearestOnEdge second = nearestOnEdge(ray, isParallel, corner, e2);
    const NearestOnEdge opposite = nearestOnEdge(ray, isParallel, add(corner, e1), subtract(e2, e1));
    const auto isSecond = hn::Lt(second.beside, first.beside);
    const auto isOpposite = hn::Lt(opposite.beside, hn::Min(first.beside, second.beside));
    const auto w1 =
        hn::IfThenElse(isOpposite, hn::Sub(one, opposite.along), hn::IfThenElse(isSecond, zero, first.along));
    const auto w2 = hn::IfThenElse(isOpposite, opposite.along, hn::IfThenElse(isSecond, second.along, zero));
    return {hn::Sub(hn::Sub(one, w1), w2), w1, w2};
}

/// Returns the barycentric weights of the intersection of the pixel's primary ray and the triangle (after Möller and
/// Trumbore 1997). The ray can miss the triangle, because the snapping of vertices moved the pixel's centre into the
/// triangle. If the triangle is almost edge-on, floats are too imprecise. In both cases, the result is the nearest
/// point of the outline. The result is therefore always a point of the triangle at this pixel. `normal` is the cross
/// product of the edges.
HWY_INLINE Weights weightsAt(
    const Vec3& ray, bool isParallel, const Vec3& fromCorner, const Vec3& e1, const Vec3& e2, const Vec3& normal) {
    const auto zero = hn::Zero(kFloats);
    const auto one = constant(1);
    const auto across = cross(fromCorner, ray);
    const auto determinant = dot(ray, normal);
    const auto largest = hn::Max(hn::Max(hn::Abs(normal.x), hn::Abs(normal.y)), hn::Abs(normal.z));
    const auto isOpen = hn::Gt(hn::Abs(determinant), hn::Max(hn::Mul(constant(1e-4F), largest), constant(1e-20F)));
    const auto scaling = inverse(hn::IfThenElse(isOpen, determinant, one));
    const auto second = hn::Neg(hn::Mul(dot(e2, across), scaling));
    const auto third = hn::Mul(dot(e1, across), scaling);
    const auto isWithin =
        hn::And(hn::And(hn::Ge(second, zero), hn::Ge(third, zero)), hn::Le(hn::Add(second, third), one));
    const auto isHit = hn::And(isOpen, isWithin);
    const Weights hit = {hn::Sub(hn::Sub(one, second), third), second, third};
    if (hn::AllTrue(kFloats, isHit)) return hit;
    const Weights nearest = nearestOnOutline(ray, isParallel, fromCorner, e1, e2);
    return {
        hn::IfThenElse(isHit, hit.first, nearest.first),
        hn::IfThenElse(isHit, hit.second, nearest.second),
        hn::IfThenElse(isHit, hit.third, nearest.third)};
}

/// Decodes an octahedral normal from two snorm16 values to a unit vector (Meyer et al. 2010). Returns zero if the
/// vertex has no normal.
HWY_INLINE Vec3 octahedral(Uints bits) {
    const auto word = hn::BitCast(kInts, bits);
    const auto decoded = [](Ints half) HWY_ATTR {
        return hn::Max(hn::Mul(toFloats(half), constant(1 / 32767.0F)), constant(-1));
    };
    const auto ex = decoded(hn::ShiftRight<16>(hn::ShiftLeft<16>(word)));
    const auto ey = decoded(hn::ShiftRight<16>(word));
    const auto one = constant(1);
    const auto z = hn::Sub(hn::Sub(one, hn::Abs(ex)), hn::Abs(ey));
    const auto isFolded = hn::Lt(z, hn::Zero(kFloats));
    const auto x = hn::IfThenElse(isFolded, hn::CopySign(hn::Sub(one, hn::Abs(ey)), ex), ex);
    const auto y = hn::IfThenElse(isFolded, hn::CopySign(hn::Sub(one, hn::Abs(ex)), ey), ey);
    const auto length = hn::Sqrt(dot({x, y, z}, {x, y, z}));
    const auto isNone = hn::RebindMask(kFloats, hn::Eq(bits, hn::Set(kUints, 0x80008000U)));
    const auto zero = hn::Zero(kFloats);
    return choose(isNone, {zero, zero, zero}, scale({x, y, z}, inverse(length)));
}

HWY_INLINE Vec3 smoothNormal(const PixelBatch& batch, std::size_t i, const Weights& weights, const Vec3& flat) {
    const auto none = hn::Set(kUints, 0x80008000U);
    const auto n0 = load(batch.normals[0], i);
    const auto n1 = load(batch.normals[1], i);
    const auto n2 = load(batch.normals[2], i);
    const auto isFlat = hn::And(hn::And(hn::Eq(n0, none), hn::Eq(n1, none)), hn::Eq(n2, none));
    if (hn::AllTrue(kUints, isFlat)) return flat;
    const Vec3 a = octahedral(n0);
    const Vec3 b = octahedral(n1);
    const Vec3 c = octahedral(n2);
    const Vec3 mixed = {weights.mix(a.x, b.x, c.x), weights.mix(a.y, b.y, c.y), weights.mix(a.z, b.z, c.z)};
    return turned(normalizedOr(mixed, flat), flat);
}

template <int shift>
HWY_INLINE Floats channel(const PixelBatch& batch, std::size_t i, const Weights& weights) {
    const auto corner = [&](std::size_t k) HWY_ATTR {
        const auto byte = hn::And(hn::ShiftRight<shift>(load(batch.colors[k], i)), hn::Set(kUints, 0xFFU));
        return toFloats(hn::BitCast(kInts, byte));
    };
    return hn::Mul(weights.mix(corner(0), corner(1), corner(2)), constant(1 / 255.0F));
}

/// Converts a colour channel in [0, 1] to the nearest integer from 0 to 255.
HWY_INLINE Ints level(Floats value) {
    const auto doubled = hn::Mul(constant(510), hn::Min(hn::Max(value, hn::Zero(kFloats)), constant(1)));
    return hn::ShiftRight<1>(hn::Add(hn::ConvertTo(kInts, doubled), hn::Set(kInts, 1)));
}

/// Packs a colour to 8-bit RGB in one word, with red in the low byte.
HWY_INLINE Ints packed(const Vec3& color) {
    return hn::Or(level(color.x), hn::Or(hn::ShiftLeft<8>(level(color.y)), hn::ShiftLeft<16>(level(color.z))));
}

/// Stores the parameters of shadow map lookups that are done later, when the maps are drawn. `pass` receives the index
/// of the map, or -1 without a lookup.
HWY_INLINE void leaveLookups(
    const ShadingFrame& f, const SurfaceLanes& surface, Ints& pass, PixelBatch& batch, std::size_t i) {
    const AwaitedLanes awaited = awaitedLookups(f, surface, pass);
    hn::StoreU(awaited.firstColumn, kInts, batch.firstColumn.data() + i);
    hn::StoreU(awaited.firstRow, kInts, batch.firstRow.data() + i);
    hn::StoreU(awaited.lastColumn, kInts, batch.lastColumn.data() + i);
    hn::StoreU(awaited.lastRow, kInts, batch.lastRow.data() + i);
    hn::StoreU(awaited.depth, kFloats, batch.lookupDepth.data() + i);
}

/// Returns the unit vector from `position` to the point light.
HWY_INLINE Vec3 towardsPoint(const block::Frame& frame, const Vec3& position) {
    const auto zero = hn::Zero(kFloats);
    return normalizedOr(subtract(constant(&frame.towardsLight.x), position), {zero, zero, zero});
}

/// Returns the brightness of the point light at `position`, relative to the sun. It decreases with the squared
/// distance, and is clamped so that it fits the range of light sums.
HWY_INLINE Floats pointStrength(const block::Frame& frame, const Vec3& position) {
    const Vec3 towards = scale(subtract(constant(&frame.towardsLight.x), position), constant(1 / frame.pointReach));
    constexpr float kMinSquare = 1.0F / 1024;
    return hn::Div(constant(1), hn::Max(dot(towards, towards), constant(kMinSquare)));
}

/// Returns the lit fraction of pixels as far as it is known without shadow map lookups.
template <class Mask>
HWY_INLINE Floats litBefore(const ShadingFrame& f, const PixelBatch& batch, std::size_t i, Mask faces) {
    if (f.litSource == LitSource::Mask) return load(batch.litMask, i);
    return hn::IfThenElseZero(faces, constant(1));
}

HWY_INLINE void shadeLanes(const ShadingFrame& f, PixelBatch& batch, std::size_t i) {
    const block::Frame& frame = *f.frame;
    const auto zero = hn::Zero(kFloats);
    const auto x = load(batch.x, i);
    const auto y = load(batch.y, i);
    const Vec3 ray = add(
        add(constant(f.rayFirst.data()), scale(constant(f.rayPerX.data()), x)), scale(constant(f.rayPerY.data()), y));
    const Vec3 corner = loadFloats(batch.corner, i);
    const Vec3 e1 = loadFloats(batch.edge1, i);
    const Vec3 e2 = loadFloats(batch.edge2, i);
    const Vec3 across = cross(e1, e2);
    Vec3 origin = constant(f.rayOriginCells.data());
    if (f.isParallel)
        origin = add(add(origin, scale(constant(f.originPerX.data()), x)), scale(constant(f.originPerY.data()), y));
    const Weights weights = weightsAt(ray, f.isParallel, subtract(origin, corner), e1, e2, across);
    const Vec3 inCells = add(add(corner, scale(e1, weights.second)), scale(e2, weights.third));
    const Vec3 position = scale(inCells, constant(frame.gridStep));
    const auto depth = hn::Add(dot(constant(&frame.viewDirection.x), position), constant(frame.originDepth));
    hn::StoreU(depth, kFloats, batch.depth.data() + i);
    if (f.litSource == LitSource::Unresolved) { // the colour is computed when the exact shadow is known
        hn::StoreU(weights.second, kFloats, batch.second.data() + i);
        hn::StoreU(weights.third, kFloats, batch.third.data() + i);
        return;
    }

    const Vec3 towardsEye = subtract(constant(&frame.eye.x), position);
    const Vec3 eyeDirection = normalizedOr(towardsEye, {zero, zero, zero});
    const Vec3 flat = turned(normalizedOr(across, eyeDirection), towardsEye);
    const Vec3 smooth = frame.isFaceted != 0 ? flat : smoothNormal(batch, i, weights, flat);
    Vec3 light = constant(&frame.towardsLight.x);
    if (frame.pointReach > 0) light = towardsPoint(frame, position);
    const auto cosine = dot(flat, light);
    const auto faces = hn::Gt(cosine, zero);
    auto pass = hn::Set(kInts, -1);
    Floats lit = litBefore(f, batch, i, faces);
    if (f.litSource == LitSource::Maps) lit = litByMaps(f, {position, flat, depth, cosine, faces}, pass);
    if (f.litSource == LitSource::Awaited) leaveLookups(f, {position, flat, depth, cosine, faces}, pass, batch, i);

    auto direct = hn::Mul(lit, hn::Max(dot(smooth, light), zero));
    if (frame.pointReach > 0) direct = hn::Mul(direct, pointStrength(frame, position));
    const Vec3 ambient = ambientLight(frame, smooth, eyeDirection);
    const Vec3 albedo = linearFromDisplay(
        {channel<0>(batch, i, weights), channel<8>(batch, i, weights), channel<16>(batch, i, weights)});
    const Vec3 inLight = reflected(albedo, add(ambient, scale(constant(&frame.sun.x), direct)));
    const Vec3 shaded = displayed(frame, inLight);
    if (f.wantsLight) store(inLight, batch.light, i);
    auto color = packed(shaded);
    if (f.litSource == LitSource::Awaited) {
        hn::StoreU(hn::BitCast(kUints, color), kUints, batch.litColor.data() + i);
        color = packed(displayed(frame, reflected(albedo, ambient)));
    }

    store(position, batch.position, i);
    store(flat, batch.flatNormal, i);
    store(shaded, batch.shaded, i);
    hn::StoreU(lit, kFloats, batch.lit.data() + i);
    hn::StoreU(pass, kInts, batch.pass.data() + i);
    hn::StoreU(hn::VecFromMask(kInts, hn::RebindMask(kInts, faces)), kInts, batch.faces.data() + i);
    hn::StoreU(hn::BitCast(kUints, color), kUints, batch.color.data() + i);
}

void shadePixelsInLanes(const ShadingFrame& frame, PixelBatch& batch) {
    for (std::size_t i = 0; i < batch.count; i += hn::Lanes(kFloats))
        shadeLanes(frame, batch, i);
}

void lookUpShadowsInLanes(const ShadingFrame& f, PointBatch& batch) {
    for (std::size_t i = 0; i < batch.count; i += hn::Lanes(kFloats)) {
        const Vec3 position = loadVec3(batch.position, i);
        const Vec3 normal = loadVec3(batch.normal, i);
        const auto depth = hn::Add(dot(constant(&f.frame->viewDirection.x), position), constant(f.frame->originDepth));
        Vec3 light = constant(&f.frame->towardsLight.x);
        if (isFromPoint(f)) light = towardsPoint(*f.frame, position);
        const auto cosine = dot(normal, light);
        auto pass = hn::Set(kInts, -1);
        const auto lit = litByMaps(f, {position, normal, depth, cosine, hn::Gt(cosine, hn::Zero(kFloats))}, pass);
        hn::StoreU(lit, kFloats, batch.lit.data() + i);
        hn::StoreU(pass, kInts, batch.pass.data() + i);
    }
}

} // namespace gnomon::render::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::render {

HWY_EXPORT(shadePixelsInLanes);
HWY_EXPORT(lookUpShadowsInLanes);

void PixelBatch::pad() {
    constexpr std::size_t kLanes = 16;
    static_assert(kMaxPixels % kLanes == 0);
    const std::size_t end = (count + kLanes - 1) / kLanes * kLanes;
    const auto repeat = [&](auto& values) {
        std::fill(
            values.begin() + static_cast<std::ptrdiff_t>(count),
            values.begin() + static_cast<std::ptrdiff_t>(end),
            values[count - 1]);
    };
    if (count == 0) return;
    repeat(x);
    repeat(y);
    repeat(litMask);
    for (auto* vectors : {&corner, &edge1, &edge2})
        for (auto& values : *vectors)
            repeat(values);
    for (auto* vectors : {&normals, &colors})
        for (auto& values : *vectors)
            repeat(values);
}

void shadePixels(const ShadingFrame& frame, PixelBatch& batch) {
    batch.pad();
    HWY_DYNAMIC_DISPATCH(shadePixelsInLanes)(frame, batch);
}

void lookUpShadows(const ShadingFrame& frame, PointBatch& batch) {
    HWY_DYNAMIC_DISPATCH(lookUpShadowsInLanes)(frame, batch);
}

} // namespace gnomon::render
#endif
