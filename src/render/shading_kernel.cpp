#include "render/shading_kernel.h"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/shading_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::render::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMostLanes = 16;

using IntTag = hn::CappedTag<std::int32_t, kMostLanes>;
using UintTag = hn::RebindToUnsigned<IntTag>;
using FloatTag = hn::RebindToFloat<IntTag>;
using Ints = hn::Vec<IntTag>;
using Uints = hn::Vec<UintTag>;
using Floats = hn::Vec<FloatTag>;
using Mask = hn::Mask<FloatTag>;

constexpr IntTag kInts;
constexpr UintTag kUints;
constexpr FloatTag kFloats;

HWY_INLINE Floats constant(float value) {
    return hn::Set(kFloats, value);
}

HWY_INLINE Floats toFloats(Ints value) {
    return hn::ConvertTo(kFloats, value);
}

HWY_INLINE Floats inverse(Floats value) {
    return hn::Div(constant(1), value);
}

struct Vec3 {
    Floats x, y, z;
};

HWY_INLINE Vec3 constant(const float* v) {
    return {constant(v[0]), constant(v[1]), constant(v[2])};
}

HWY_INLINE Vec3 add(const Vec3& a, const Vec3& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

HWY_INLINE Vec3 subtract(const Vec3& a, const Vec3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vec3 scale(const Vec3& a, Floats by) {
    return {hn::Mul(a.x, by), hn::Mul(a.y, by), hn::Mul(a.z, by)};
}

HWY_INLINE Vec3 choose(Mask mask, const Vec3& yes, const Vec3& no) {
    return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

HWY_INLINE Floats dot(const Vec3& a, const Vec3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Vec3 cross(const Vec3& a, const Vec3& b) {
    return {
        hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
        hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
        hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

/// `a` where it points to the same side as `towards`, else its opposite.
HWY_INLINE Vec3 turned(const Vec3& a, const Vec3& towards) {
    const auto isAway = hn::Lt(dot(a, towards), hn::Zero(kFloats));
    return choose(isAway, {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)}, a);
}

/// `a` of length 1 where it has one that is not 0, else `otherwise`.
HWY_INLINE Vec3 normalizedOr(const Vec3& a, const Vec3& otherwise) {
    const auto square = dot(a, a);
    const auto hasLength = hn::Gt(square, hn::Zero(kFloats));
    const auto length = hn::Sqrt(hn::IfThenElse(hasLength, square, constant(1)));
    return choose(hasLength, scale(a, inverse(length)), otherwise);
}

template <class T>
HWY_INLINE auto load(const PixelBatch::Values<T>& values, std::size_t i) {
    return hn::LoadU(hn::Rebind<T, IntTag>(), values.data() + i);
}

template <class T>
HWY_INLINE Vec3 loadFloats(const PixelBatch::Vectors<T>& values, std::size_t i) {
    return {toFloats(load(values[0], i)), toFloats(load(values[1], i)), toFloats(load(values[2], i))};
}

HWY_INLINE void store(const Vec3& v, PixelBatch::Vectors<float>& values, std::size_t i) {
    hn::StoreU(v.x, kFloats, values[0].data() + i);
    hn::StoreU(v.y, kFloats, values[1].data() + i);
    hn::StoreU(v.z, kFloats, values[2].data() + i);
}

/// Weights of corner 1 and corner 2.
struct Weights {
    Floats first, second, third;

    HWY_INLINE Floats mix(Floats a, Floats b, Floats c) const {
        return hn::Add(hn::Add(hn::Mul(first, a), hn::Mul(second, b)), hn::Mul(third, c));
    }
};

/// Where the pixel's ray meets the triangle (after Möller and Trumbore 1997); held inside of it, since the centre of a
/// pixel that snapping put inside may lie a little without. `normal` is across the edges.
HWY_INLINE Weights
weightsAt(const Vec3& ray, const Vec3& fromCorner, const Vec3& e1, const Vec3& e2, const Vec3& normal) {
    const auto across = cross(fromCorner, ray);
    const auto determinant = dot(ray, normal);
    // Seen edge-on it is met everywhere or nowhere.
    const auto isMet = hn::Gt(hn::Abs(determinant), constant(1e-20F));
    const auto scaling = hn::IfThenElseZero(isMet, inverse(hn::IfThenElse(isMet, determinant, constant(1))));
    const auto held = [](Floats w) HWY_ATTR { return hn::Min(hn::Max(w, hn::Zero(kFloats)), constant(1e6F)); };
    auto second = held(hn::Neg(hn::Mul(dot(e2, across), scaling)));
    auto third = held(hn::Mul(dot(e1, across), scaling));
    const auto excess = inverse(hn::Max(hn::Add(second, third), constant(1)));
    second = hn::Mul(second, excess);
    third = hn::Mul(third, excess);
    return {hn::Sub(hn::Sub(constant(1), second), third), second, third};
}

/// Two snorm16 on the octahedron (Meyer et al. 2010); zero where the face's own normal is to be taken.
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

/// The nearest of 255 levels.
HWY_INLINE Ints level(Floats value) {
    const auto doubled = hn::Mul(constant(510), hn::Min(hn::Max(value, hn::Zero(kFloats)), constant(1)));
    return hn::ShiftRight<1>(hn::Add(hn::ConvertTo(kInts, doubled), hn::Set(kInts, 1)));
}

HWY_INLINE Ints sliceOf(const ShadingFrame& f, Floats z) {
    auto slice = hn::Zero(kInts);
    for (int s = 0; s + 1 < f.frame->counts.x; ++s) {
        const auto isBehind = hn::RebindMask(kInts, hn::Ge(z, constant(f.shadows->splits[s].y)));
        slice = hn::IfThenElse(isBehind, hn::Set(kInts, s + 1), slice);
    }
    return slice;
}

/// `p` from the eye.
HWY_INLINE Ints faceOf(const ShadingFrame& f, const Vec3& p, Ints slice) {
    const block::Shadows& shadows = *f.shadows;
    const auto zero = hn::Zero(kFloats);
    const int faces = f.frame->counts.z;
    auto face = hn::Set(kInts, faces - 1);
    for (int i = faces - 2; i >= 0; --i) {
        const auto first = hn::Ge(dot(constant(&shadows.faceFirst[i].x), p), zero);
        const auto second = hn::Ge(dot(constant(&shadows.faceSecond[i].x), p), zero);
        face = hn::IfThenElse(hn::RebindMask(kInts, hn::And(first, second)), hn::Set(kInts, i), face);
    }
    if (f.frame->counts.w != 1) return face;
    const auto edge = [&](int k) HWY_ATTR {
        return hn::GatherIndex(kFloats, &shadows.faceEdge[0].x + k, hn::ShiftLeft<2>(face));
    };
    const auto sliceNear = hn::GatherIndex(kFloats, &shadows.splits[0].x, hn::ShiftLeft<2>(slice));
    const auto inNear = hn::Lt(dot({edge(0), edge(1), edge(2)}, p), hn::Mul(edge(3), sliceNear));
    return hn::IfThenElse(hn::RebindMask(kInts, inNear), hn::Set(kInts, faces), face);
}

HWY_INLINE Ints passOf(const ShadingFrame& f, const Vec3& p, Floats z) {
    const auto slice = sliceOf(f, z);
    const int facesPerSlice = std::max(f.frame->counts.z, 1) + f.frame->counts.w;
    auto index = hn::Mul(slice, hn::Set(kInts, facesPerSlice));
    if (f.frame->counts.z != 0) index = hn::Add(index, faceOf(f, p, slice));
    return hn::GatherIndex(kInts, &f.shadows->passOfPartition[0].x, index);
}

constexpr int kPartitionFloats = sizeof(block::Partition) / sizeof(float);
constexpr int kInverse = offsetof(block::Partition, drawFromTexel) / sizeof(float);
constexpr int kUnevenX = offsetof(block::Partition, axisX) / sizeof(float) + 3;
constexpr int kUnevenZ = offsetof(block::Partition, axisZ) / sizeof(float) + 3;
constexpr int kRectangle = offsetof(block::Partition, rectangle) / sizeof(float);
static_assert(offsetof(block::Partition, texelFromDraw) == 0);

/// The values of each lane's partition; one for all where they agree.
template <bool isUniform>
class PartitionLanes {
public:
    HWY_INLINE PartitionLanes(const ShadingFrame& f, Ints pass)
        : base_(&f.shadows->partitions[isUniform ? hn::GetLane(pass) : 0].texelFromDraw[0].x),
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

template <class Partition>
HWY_INLINE Floats texelCoordinate(const Partition& part, int row, const Vec3& p) {
    return hn::Add(
        hn::Add(hn::Mul(part(row), p.x), hn::Mul(part(4 + row), p.y)),
        hn::Add(hn::Mul(part(8 + row), p.z), part(12 + row)));
}

/// The bias that a flat receiver, and a neighbour somewhat steeper, needs over half a texel and the kernel; `w` is the
/// map's at `p`.
template <class Partition>
HWY_INLINE Floats
receiverBias(const ShadingFrame& f, const Partition& part, const Vec3& p, const Vec3& normal, Floats cosine, Floats w) {
    const auto offset = hn::Neg(dot(normal, p));
    const auto inTexels = [&](int column) HWY_ATTR {
        const int k = kInverse + 4 * column;
        return hn::Add(dot(normal, {part(k), part(k + 1), part(k + 2)}), hn::Mul(offset, part(k + 3)));
    };
    const float reach = 0.5F + 0.5F * static_cast<float>(std::max(f.frame->counts.y, 1) - 1) + 1.0F / 256.0F;
    const auto across = hn::Max(hn::Abs(inTexels(2)), constant(1e-30F));
    const auto slope = hn::Div(hn::Add(hn::Abs(inTexels(0)), hn::Abs(inTexels(1))), across);
    const auto grazing = hn::Min(constant(1), hn::Mul(cosine, constant(10)));
    const auto unevenX = part(kUnevenX);
    const auto unevenZ = hn::Mul(part(kUnevenZ), w);
    const auto uneven = hn::Sqrt(hn::Add(hn::Mul(unevenX, unevenX), hn::Mul(unevenZ, unevenZ)));
    return hn::Add(hn::Mul(hn::Add(hn::Mul(slope, grazing), uneven), constant(reach)), constant(6e-7F));
}

template <bool isUniform>
HWY_INLINE Floats litFraction(const ShadingFrame& f, Ints pass, const Vec3& p, const Vec3& normal, Floats cosine) {
    const PartitionLanes<isUniform> part(f, pass);
    const auto w = texelCoordinate(part, 3, p);
    // No receiver lies in the plane of w = 0; should one, it must not become a NaN.
    const auto isFinite = hn::Gt(hn::Abs(w), constant(1e-30F));
    const auto inverseW = inverse(hn::IfThenElse(isFinite, w, constant(1e-30F)));
    const auto depth =
        hn::Sub(hn::Mul(texelCoordinate(part, 2, p), inverseW), receiverBias(f, part, p, normal, cosine, w));
    const int width = std::max(f.frame->counts.y, 1);
    const auto half = constant(0.5F * static_cast<float>(width - 1));
    const auto far = constant(1e6F);
    const auto firstOf = [&](int row) HWY_ATTR {
        const auto first = hn::Floor(hn::Sub(hn::Mul(texelCoordinate(part, row, p), inverseW), half));
        return hn::ConvertTo(kInts, hn::Min(hn::Max(first, hn::Neg(far)), far));
    };
    const auto firstX = firstOf(0);
    const auto firstY = firstOf(1);
    const auto side = [&](int k) HWY_ATTR { return hn::ConvertTo(kInts, part(kRectangle + k)); };
    const auto one = hn::Set(kInts, 1);
    const auto lowX = side(0);
    const auto lowY = side(1);
    const auto highX = hn::Sub(side(2), one);
    const auto highY = hn::Sub(side(3), one);
    auto lit = hn::Zero(kFloats);
    for (int y = 0; y < width; ++y) {
        const auto row = hn::Min(hn::Max(hn::Add(firstY, hn::Set(kInts, y)), lowY), highY);
        const auto start = hn::Mul(row, hn::Set(kInts, f.shadowWidth));
        for (int x = 0; x < width; ++x) {
            const auto column = hn::Min(hn::Max(hn::Add(firstX, hn::Set(kInts, x)), lowX), highX);
            const auto stored = hn::GatherIndex(kFloats, f.shadowDepth, hn::Add(start, column));
            lit = hn::Add(lit, hn::IfThenElseZero(hn::Le(depth, stored), constant(1)));
        }
    }
    return hn::Div(lit, constant(static_cast<float>(width * width)));
}

/// Asks the maps where the surface faces the light; `pass` becomes -1 elsewhere.
HWY_INLINE Floats
litByMaps(const ShadingFrame& f, const Vec3& p, const Vec3& normal, Floats z, Floats cosine, Mask faces, Ints& pass) {
    const auto none = hn::Set(kInts, -1);
    const auto isFacing = hn::RebindMask(kInts, faces);
    pass = none;
    if (hn::AllFalse(kFloats, faces)) return hn::Zero(kFloats);
    const auto relative = subtract(p, constant(&f.frame->eye.x));
    pass = hn::IfThenElse(isFacing, passOf(f, relative, z), none);
    const auto isAsked = hn::Gt(pass, none);
    auto lit = constant(1);
    if (!hn::AllFalse(kInts, isAsked)) {
        const auto largest = hn::MaxOfLanes(kInts, pass);
        const auto filled = hn::IfThenElse(isAsked, pass, largest);
        const auto asked = hn::AllTrue(kInts, hn::Eq(filled, largest))
                               ? litFraction<true>(f, filled, p, normal, cosine)
                               : litFraction<false>(f, filled, p, normal, cosine);
        lit = hn::IfThenElse(hn::RebindMask(kFloats, isAsked), asked, lit);
    }
    return hn::IfThenElseZero(faces, lit);
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
    const Weights weights = weightsAt(ray, subtract(constant(f.rayOriginCells.data()), corner), e1, e2, across);
    const Vec3 inCells = add(add(corner, scale(e1, weights.second)), scale(e2, weights.third));
    const Vec3 position = scale(inCells, constant(frame.eye.w));

    const Vec3 towardsEye = subtract(constant(&frame.eye.x), position);
    const Vec3 eyeDirection = normalizedOr(towardsEye, {zero, zero, zero});
    const Vec3 flat = turned(normalizedOr(across, eyeDirection), towardsEye);
    const Vec3 smooth = smoothNormal(batch, i, weights, flat);
    const auto depth = hn::Add(dot(constant(&frame.view.x), position), constant(frame.view.w));
    const Vec3 light = constant(&frame.light.x);
    const auto cosine = dot(flat, light);
    const auto faces = hn::Gt(cosine, zero);
    auto pass = hn::Set(kInts, -1);
    Floats lit = hn::IfThenElseZero(faces, f.litSource == LitSource::Mask ? load(batch.litMask, i) : constant(1));
    if (f.litSource == LitSource::Maps) lit = litByMaps(f, position, flat, depth, cosine, faces, pass);

    const auto direct = hn::Mul(lit, hn::Max(dot(smooth, light), zero));
    const auto facing = hn::Abs(dot(smooth, eyeDirection));
    const auto strength =
        hn::Add(hn::Add(constant(0.22F), hn::Mul(constant(0.14F), facing)), hn::Mul(constant(0.64F), direct));
    const Vec3 shaded =
        scale({channel<0>(batch, i, weights), channel<8>(batch, i, weights), channel<16>(batch, i, weights)}, strength);
    const auto color =
        hn::Or(level(shaded.x), hn::Or(hn::ShiftLeft<8>(level(shaded.y)), hn::ShiftLeft<16>(level(shaded.z))));

    store(position, batch.position, i);
    store(flat, batch.flatNormal, i);
    store(shaded, batch.shaded, i);
    hn::StoreU(depth, kFloats, batch.depth.data() + i);
    hn::StoreU(lit, kFloats, batch.lit.data() + i);
    hn::StoreU(pass, kInts, batch.pass.data() + i);
    hn::StoreU(hn::VecFromMask(kInts, hn::RebindMask(kInts, faces)), kInts, batch.faces.data() + i);
    hn::StoreU(hn::BitCast(kUints, color), kUints, batch.color.data() + i);
}

void shadePixelsInLanes(const ShadingFrame& frame, PixelBatch& batch) {
    for (std::size_t i = 0; i < batch.count; i += hn::Lanes(kFloats))
        shadeLanes(frame, batch, i);
}

} // namespace gnomon::render::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::render {

HWY_EXPORT(shadePixelsInLanes);

void PixelBatch::pad() {
    constexpr std::size_t kLanes = 16;
    static_assert(kMost % kLanes == 0);
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

} // namespace gnomon::render
#endif
