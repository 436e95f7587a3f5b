// Exact shadows of a point light: tests one triangle against adjacent samples, with one sample per SIMD lane. The code
// uses doubles where their error bounds suffice, and integers otherwise. The header is compiled once per SIMD
// instruction set.
#if defined(GNOMON_EXACT_POINT_SPAN_TEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_EXACT_POINT_SPAN_TEST_INL_H
#undef GNOMON_EXACT_POINT_SPAN_TEST_INL_H
#else
#define GNOMON_EXACT_POINT_SPAN_TEST_INL_H
#endif

#include "exact/span_test-inl.h"

HWY_BEFORE_NAMESPACE();

namespace gnomon::exact::HWY_NAMESPACE {

/// A triangle and a point light, prepared for tests against samples.
///
/// Let A be the first corner relative to the light, b and c the edges from this corner, d = sample - corner A, and n =
/// b x c. The edge functions of AB and CA are (A x b) . d and -(A x c) . d. The edge function of BC is n . (A + d)
/// minus the other two. All are multiplied by the sign of n . A. If n . d is then positive, the triangle's plane lies
/// between the sample and the light.
///
/// The error bounds use these terms: samples have an error of e per axis; corners and the light are whole numbers below
/// 2^53; |x| is the sum of the absolute components of x; R = |A|; s is the larger of |b| and |c|; u = 2^-53. The error
/// of d is e plus one rounding.
/// - A component of A x b is at most R s, with an error of 3 u R s. Its product with d has an error of R s (3 e + 7 u
/// |d|).
/// - In the same way, n . d has an error of s^2 (3 e + 7 u |d|), and n . A has an error of 7 u s^2 R.
/// - The third edge function sums these three terms, with sizes R s |d|, R s |d|, s^2 |d| and s^2 R, and three
/// roundings:
///   e (6 R s + 3 s^2) + u |d| (20 R s + 10 s^2) + 10 u s^2 R.
/// The code doubles all bounds. This covers the rounding of R, s, |d| and of the bounds.
struct PointTriangleTest {
    double a[3] = {};         // corner A, in the coordinates of the samples
    double fromLight[3] = {}; // corner A relative to the light
    double ab[3] = {};        // A x b, times the sign
    double ca[3] = {};        // -(A x c), times the sign
    double normal[3] = {};    // n, times the sign
    double volume = 0;        // n . A, times the sign: positive
    double size = 0;          // |n|
    double edgeError[2] = {};
    double heightError[2] = {}; // error of n . d: [0] + [1] * |d|
    bool isWhole = false;       // true: all sums in n are below 2^53, so n is exact
    int flat = -1;              // the axis along which all corners are equal, or -1
    std::uint32_t name = 0;

    /// Prepares the triangle for sample tests. Returns false if the light lies in the triangle's plane, because the
    /// triangle then casts no shadow. `orientation` returns the exact sign of n . A.
    template <class Orientation>
    HWY_INLINE bool set(
        const double* pa,
        const double* pb,
        const double* pc,
        const glm::dvec3& light,
        double error,
        const Orientation& orientation);

    /// Returns true if doubles prove that triangle `corners` lies in the plane of this triangle. Examples are duplicate
    /// triangles and overlapping floors. The proof needs triangles that are flat along the same axis, or whole-number
    /// sums below 2^53. `corners` are in the coordinates of the samples.
    HWY_INLINE bool surelyHolds(const Corners& corners) const;
};

HWY_INLINE void crossOf(const double* a, const double* b, double* result) {
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

HWY_INLINE double sumOfSizes(const double* a) {
    return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]);
}

template <class Orientation>
HWY_INLINE bool PointTriangleTest::set(
    const double* pa,
    const double* pb,
    const double* pc,
    const glm::dvec3& light,
    double error,
    const Orientation& orientation) {
    constexpr double kRounding = 0x1p-52; // twice the rounding unit of a double
    double b[3];
    double c[3];
    for (int i = 0; i < 3; ++i) {
        a[i] = pa[i];
        fromLight[i] = pa[i] - light[i];
        b[i] = pb[i] - pa[i];
        c[i] = pc[i] - pa[i];
        if (b[i] == 0 && c[i] == 0) flat = i;
    }
    const double reach = sumOfSizes(fromLight);
    const double s = std::max(sumOfSizes(b), sumOfSizes(c));
    crossOf(fromLight, b, ab);
    crossOf(c, fromLight, ca);
    crossOf(b, c, normal);
    size = sumOfSizes(normal);
    isWhole = 2 * s * s < 0x1p53;
    volume = normal[0] * fromLight[0] + normal[1] * fromLight[1] + normal[2] * fromLight[2];
    edgeError[0] = 2 * error * (6 * reach * s + 3 * s * s) + 10 * kRounding * s * s * reach;
    edgeError[1] = kRounding * (20 * reach * s + 10 * s * s);
    heightError[0] = 2 * error * 3 * s * s;
    heightError[1] = 7 * kRounding * s * s;
    double turn = volume < 0 ? -1 : 1;
    if (std::abs(volume) <= 7 * kRounding * s * s * reach) {
        turn = orientation();
        if (turn == 0) return false;
    }
    for (int i = 0; i < 3; ++i) {
        ab[i] *= turn;
        ca[i] *= turn;
        normal[i] *= turn;
    }
    volume *= turn;
    return true;
}

HWY_INLINE bool PointTriangleTest::surelyHolds(const Corners& corners) const {
    for (const glm::i64vec3& corner : corners) {
        double d[3];
        for (int i = 0; i < 3; ++i)
            d[i] = static_cast<double>(corner[i]) - a[i];
        if (flat >= 0) {
            if (d[flat] != 0) return false;
            continue;
        }
        if (!isWhole || size * sumOfSizes(d) >= 0x1p53) return false;
        if (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2] != 0) return false;
    }
    return true;
}

HWY_INLINE Doubles dotLanes(const double* a, Doubles x, Doubles y, Doubles z) {
    return hn::MulAdd(constant(a[0]), x, hn::MulAdd(constant(a[1]), y, hn::Mul(constant(a[2]), z)));
}

/// Bounds of `height` (N . d) if the triangle's plane is one cell ahead of the sample along the ray to the light. `d`
/// is the sample minus corner A. The rounding of ray directions adds an uncertainty of `slack` times the size of the
/// normal. Near the light, the bounds are the widest possible interval.
struct CellAheadLanes {
    Doubles min, max;

    HWY_INLINE CellAheadLanes(const PointTriangleTest& t, Doubles height, Doubles dx, Doubles dy, Doubles dz) {
        constexpr double kSlack = 1e-6;
        constexpr double kNear = 64; // cells
        const auto x = hn::Add(dx, constant(t.fromLight[0]));
        const auto y = hn::Add(dy, constant(t.fromLight[1]));
        const auto z = hn::Add(dz, constant(t.fromLight[2]));
        const auto length = hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))));
        const auto slant = hn::Div(hn::Abs(hn::Add(constant(t.volume), height)), length);
        const auto isNear = hn::Lt(length, constant(kNear));
        const auto slack = constant(kSlack * t.size);
        min = hn::IfThenElse(isNear, hn::Zero(kDoubles), hn::Sub(slant, slack));
        max = hn::IfThenElse(isNear, constant(t.size), hn::Add(slant, slack));
    }
};

/// Tests a triangle of a point light's shadows against the samples [begin, end). The function marks certain results,
/// and calls `resolve(place, mayCast)` for samples that need integers. The tolerance of two grid steps is rounded to
/// whole units of 2^-24 of a direction, so it is one to two cells along h.
template <class Resolve>
HWY_INLINE void testSamples(
    const PointTriangleTest& t,
    const CasterContext& context,
    std::size_t begin,
    std::size_t end,
    const Resolve& resolve) {
    const SampleList& samples = *context.samples;
    constexpr double kMinTolerance = 0.999; // cells
    constexpr double kMaxTolerance = 2.001;
    const auto zero = hn::Zero(kDoubles);
    for (std::size_t i = begin; i < end; i += hn::Lanes(kDoubles)) {
        const auto dx = hn::Sub(hn::LoadU(kDoubles, &samples.u[i]), constant(t.a[0]));
        const auto dy = hn::Sub(hn::LoadU(kDoubles, &samples.v[i]), constant(t.a[1]));
        const auto dz = hn::Sub(hn::LoadU(kDoubles, &samples.h[i]), constant(t.a[2]));
        const auto first = dotLanes(t.ab, dx, dy, dz);
        const auto third = dotLanes(t.ca, dx, dy, dz);
        const auto height = dotLanes(t.normal, dx, dy, dz);
        const auto second = hn::Sub(hn::Sub(hn::Add(constant(t.volume), height), first), third);
        const auto min = hn::Min(hn::Min(first, second), third);
        const auto size = hn::Add(hn::Add(hn::Abs(dx), hn::Abs(dy)), hn::Abs(dz));
        const auto edgeError = hn::MulAdd(size, constant(t.edgeError[1]), constant(t.edgeError[0]));
        const auto heightError = hn::MulAdd(size, constant(t.heightError[1]), constant(t.heightError[0]));
        const auto mayCover = hn::And(hn::FirstN(kDoubles, end - i), hn::Ge(hn::Add(min, edgeError), zero));
        const auto mayBeAhead = hn::And(mayCover, hn::Ge(hn::Add(height, heightError), zero));
        if (hn::AllFalse(kDoubles, mayBeAhead)) continue;
        const CellAheadLanes cell(t, height, dx, dy, dz);
        const auto covers = hn::And(mayBeAhead, hn::Gt(min, edgeError));
        const auto isFar = hn::Gt(height, hn::MulAdd(cell.max, constant(kMaxTolerance), heightError));
        const auto isDark = hn::And(covers, isFar);
        forLanes(isDark, [&](std::size_t lane) { markDark(context.statuses[i + lane]); });
        const auto isNear = hn::Lt(hn::Add(height, heightError), hn::Mul(cell.min, constant(kMinTolerance)));
        const auto touches = hn::And(hn::And(covers, isNear), hn::Gt(height, heightError));
        forLanes(touches, [&](std::size_t lane) {
            if (context.grid->triangle[i + lane] != t.name) mark(context.statuses[i + lane], kWithinTolerance);
        });
        forLanes(hn::AndNot(hn::Or(isDark, touches), mayBeAhead), [&](std::size_t lane) {
            if (context.grid->triangle[i + lane] != t.name) resolve(i + lane, true);
        });
    }
}

} // namespace gnomon::exact::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
