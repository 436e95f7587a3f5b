#include "preprocess/proximity/triangle_batch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preprocess/proximity/triangle_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::proximity::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, TriangleBatch::kCapacity>;
using Doubles = hn::Vec<Tag>;
using Corner = std::array<TriangleBatch::Row, 3>;

constexpr Tag kDoubles;

struct Vector {
    Doubles x;
    Doubles y;
    Doubles z;
};

HWY_INLINE Vector load(const Corner& corner, std::size_t i) {
    return {
        hn::LoadU(kDoubles, corner[0].data() + i),
        hn::LoadU(kDoubles, corner[1].data() + i),
        hn::LoadU(kDoubles, corner[2].data() + i)};
}

HWY_INLINE Vector minus(const Vector& a, const Vector& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vector times(const Vector& a, Doubles scale) {
    return {hn::Mul(a.x, scale), hn::Mul(a.y, scale), hn::Mul(a.z, scale)};
}

HWY_INLINE Doubles dot(const Vector& a, const Vector& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Doubles squareOf(const Vector& v) {
    return dot(v, v);
}

/// Returns a * b - c * d in each SIMD lane.
HWY_INLINE Doubles crossed(Doubles a, Doubles b, Doubles c, Doubles d) {
    return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
}

/// Returns the squared length of `offset - edge * (part / whole)` in each SIMD lane. In lanes where `isSome` is false,
/// it returns the squared length of `offset`.
template <class Mask>
HWY_INLINE Doubles squareBeside(const Vector& offset, const Vector& edge, Doubles part, Doubles whole, Mask isSome) {
    const Doubles along = hn::IfThenElseZero(isSome, hn::Div(part, whole));
    return squareOf(minus(offset, times(edge, along)));
}

/// Clamps `v` to the range from 0 to `upper` in each SIMD lane, with the same result as std::clamp.
HWY_INLINE Doubles clamped(Doubles v, Doubles upper) {
    const Doubles zero = hn::Zero(kDoubles);
    return hn::IfThenElse(hn::Lt(v, zero), zero, hn::IfThenElse(hn::Lt(upper, v), upper, v));
}

/// Returns the squared distance from `p` to the triangle in each SIMD lane. The scalar function `squaredDistance`
/// returns the result of the first case that is true. This code computes all cases in reverse order, so that an earlier
/// case overwrites a later one.
HWY_INLINE Doubles nearestSquaresOf(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
    const Doubles zero = hn::Zero(kDoubles);
    const Doubles one = hn::Set(kDoubles, 1.0);
    const Vector ab = minus(b, a);
    const Vector ac = minus(c, a);
    const Vector ap = minus(p, a);
    const Vector bp = minus(p, b);
    const Vector cp = minus(p, c);
    const Doubles abAp = dot(ab, ap);
    const Doubles acAp = dot(ac, ap);
    const Doubles abBp = dot(ab, bp);
    const Doubles acBp = dot(ac, bp);
    const Doubles abCp = dot(ab, cp);
    const Doubles acCp = dot(ac, cp);
    const Doubles besideC = crossed(abAp, acBp, abBp, acAp);
    const Doubles besideB = crossed(abCp, acAp, abAp, acCp);
    const Doubles besideA = crossed(abBp, acCp, abCp, acBp);

    const Doubles scale = hn::Div(one, hn::Add(hn::Add(besideA, besideB), besideC));
    const Doubles v = clamped(hn::Mul(besideB, scale), one);
    const Doubles w = clamped(hn::Mul(besideC, scale), hn::Sub(one, v));
    Doubles square = squareOf(minus(minus(ap, times(ab, v)), times(ac, w)));

    const auto use = [&](auto isHere, Doubles here) { square = hn::IfThenElse(isHere, here, square); };
    const Doubles towardsC = hn::Sub(acBp, abBp);
    const Doubles towardsB = hn::Sub(abCp, acCp);
    const Doubles sum = hn::Add(towardsC, towardsB);
    use(hn::And(hn::Le(besideA, zero), hn::And(hn::Ge(towardsC, zero), hn::Ge(towardsB, zero))),
        squareBeside(bp, minus(c, b), towardsC, sum, hn::Gt(sum, zero)));
    use(hn::And(hn::Le(besideB, zero), hn::And(hn::Ge(acAp, zero), hn::Le(acCp, zero))),
        squareBeside(ap, ac, acAp, hn::Sub(acAp, acCp), hn::Gt(acAp, acCp)));
    use(hn::And(hn::Ge(acCp, zero), hn::Le(abCp, acCp)), squareOf(cp));
    use(hn::And(hn::Le(besideC, zero), hn::And(hn::Ge(abAp, zero), hn::Le(abBp, zero))),
        squareBeside(ap, ab, abAp, hn::Sub(abAp, abBp), hn::Gt(abAp, abBp)));
    use(hn::And(hn::Ge(abBp, zero), hn::Le(acBp, abBp)), squareOf(bp));
    use(hn::And(hn::Le(abAp, zero), hn::Le(acAp, zero)), squareOf(ap));
    return square;
}

void squaresInLanes(
    const glm::dvec3& point, const std::array<Corner, 3>& corners, std::size_t count, TriangleBatch::Row& squares) {
    const Vector p{hn::Set(kDoubles, point.x), hn::Set(kDoubles, point.y), hn::Set(kDoubles, point.z)};
    for (std::size_t i = 0; i < count; i += hn::Lanes(kDoubles))
        hn::StoreU(
            nearestSquaresOf(p, load(corners[0], i), load(corners[1], i), load(corners[2], i)),
            kDoubles,
            squares.data() + i);
}

} // namespace gnomon::proximity::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::proximity {

HWY_EXPORT(squaresInLanes);

void TriangleBatch::squaredDistances(const glm::dvec3& point, Row& squares) const {
    HWY_DYNAMIC_DISPATCH(squaresInLanes)(point, corners_, count_, squares);
}

} // namespace gnomon::proximity
#endif
