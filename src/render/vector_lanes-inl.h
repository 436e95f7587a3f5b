// SIMD types and functions for numbers and 3D vectors, with one value per lane. The header is compiled once per SIMD
// instruction set.
#if defined(GNOMON_RENDER_VECTOR_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RENDER_VECTOR_LANES_INL_H
#undef GNOMON_RENDER_VECTOR_LANES_INL_H
#else
#define GNOMON_RENDER_VECTOR_LANES_INL_H
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::render::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMaxLanes = 16;

using IntTag = hn::CappedTag<std::int32_t, kMaxLanes>;
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

/// Returns the natural logarithm of finite positive values, with an error of at most 2e-7 of the result plus 1e-7. The
/// result is identical on all instruction sets. The function uses value = 2^e m, with m between sqrt(1/2) and sqrt 2.
/// With s = (m - 1) / (m + 1), ln m is 2 artanh s.
HWY_INLINE Floats naturalLog(Floats value) {
    constexpr std::int32_t kRootOfHalf = 0x3F3504F3;
    const auto bits = hn::Sub(hn::BitCast(kInts, value), hn::Set(kInts, kRootOfHalf));
    const auto exponent = hn::ShiftRight<23>(bits);
    const auto mantissa = hn::Add(hn::And(bits, hn::Set(kInts, 0x7FFFFF)), hn::Set(kInts, kRootOfHalf));
    const auto m = hn::BitCast(kFloats, mantissa);
    const auto s = hn::Div(hn::Sub(m, constant(1)), hn::Add(m, constant(1)));
    const auto square = hn::Mul(s, s);
    auto series = constant(2.0F / 9);
    for (const float term : {2.0F / 7, 2.0F / 5, 2.0F / 3, 2.0F})
        series = hn::Add(hn::Mul(series, square), constant(term));
    // The upper part of ln 2 has so few bits that its product with an exponent is exact.
    const auto e = toFloats(exponent);
    const auto low = hn::Add(hn::Mul(s, series), hn::Mul(e, constant(-2.12194440e-4F)));
    return hn::Add(hn::Mul(e, constant(0.693359375F)), low);
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

/// Returns `a` or -`a`: the vector whose dot product with `towards` is not negative.
HWY_INLINE Vec3 turned(const Vec3& a, const Vec3& towards) {
    const auto isAway = hn::Lt(dot(a, towards), hn::Zero(kFloats));
    return choose(isAway, {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)}, a);
}

/// Returns `a` scaled to unit length, or `otherwise` if the length of `a` is 0.
HWY_INLINE Vec3 normalizedOr(const Vec3& a, const Vec3& otherwise) {
    const auto square = dot(a, a);
    const auto hasLength = hn::Gt(square, hn::Zero(kFloats));
    const auto length = hn::Sqrt(hn::IfThenElse(hasLength, square, constant(1)));
    return choose(hasLength, scale(a, inverse(length)), otherwise);
}

} // namespace gnomon::render::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
