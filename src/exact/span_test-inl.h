// Exact shadows: tests one triangle against adjacent samples, with one sample per SIMD lane. The code uses doubles
// where their error bounds suffice, and integers otherwise. The header is compiled once per SIMD instruction set.
#if defined(GNOMON_EXACT_SPAN_TEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_EXACT_SPAN_TEST_INL_H
#undef GNOMON_EXACT_SPAN_TEST_INL_H
#else
#define GNOMON_EXACT_SPAN_TEST_INL_H
#endif

#include "exact/caster_context.h"

#include <atomic>
#include <cmath>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::exact::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DoubleTag = hn::ScalableTag<double>;
using Doubles = hn::Vec<DoubleTag>;
constexpr DoubleTag kDoubles;
constexpr hn::Rebind<std::int64_t, DoubleTag> kWides;
constexpr hn::Rebind<std::int32_t, DoubleTag> kNarrows;

HWY_INLINE Doubles constant(double value) {
    return hn::Set(kDoubles, value);
}

/// A triangle in the sheared light space, prepared for tests against samples.
///
/// Let d = sample - A and N = (B - A) x (C - A). `ab` and `ca` define the edge functions of AB and CA. The edge
/// function of BC is the area minus the other two. The height of the triangle's plane above the sample is -N . d /
/// area.
///
/// The error bounds use these terms: coordinates have an error of e; |x| is the sum of the absolute components of x; s
/// is the larger of |B - A| and |C - A|; u = 2^-53. A difference has an error of 2 e plus one rounding. A 2 x 2
/// determinant of differences p and q has an error of 2 e (|p| + |q|) + 8 e^2 + 4 u |p| |q|.
/// - The area therefore has an error of 4 e s + 8 e^2 + 4 u s^2.
/// - The edge functions of AB and CA have an error of 2 e (s + |d|) + 8 e^2 + 4 u s |d|.
/// - The two differences of the third edge function add 2 u s^2 + 3 u s |d|. The bound for all three edge functions is
/// 8 e s + 24 e^2 + 6 u s^2 + (4 e + 11 u s) |d|.
/// - |N| is at most s^2. N . d has an error of 2 e s^2 + (4 e s + 8 e^2 + 8 u s^2) |d|. Terms of e^2 s are omitted.
/// They are small compared with e s^2, because corners are whole cells apart and e is below 2^-17.
/// - The error of area * tolerance is the same as for a |d| of the size of the tolerance.
///
/// kRounding is 2 u, and the code doubles all bounds again. This covers the rounding of s, of |d| and of the bounds.
struct TriangleTest {
    double a[3] = {};  // corner A: u, v, h
    double ab[2] = {}; // edge function of AB: its u and v, with the sign that makes the area positive
    double ca[2] = {};
    double area = 0;
    double normal[2] = {};      // u and v of N; the h of N is the area
    double size = 0;            // s as defined above
    double edgeError[2] = {};   // error of an edge function: [0] + [1] * |d|
    double heightError[2] = {}; // error of N . d - area * tolerance: [0] + [1] * (|d| + the largest tolerance)
    // Id of the triangle. Samples with this id lie on the triangle, so the test skips them.
    std::uint32_t name = 0;

    /// Prepares the triangle for sample tests. Returns false if the triangle's plane is parallel to the light, because
    /// the triangle then casts no shadow. `orientation` returns the exact sign of the area if rounding may hide it.
    template <class Orientation>
    HWY_INLINE bool set(
        const double* pa, const double* pb, const double* pc, double error, const Orientation& orientation);
};

template <class Orientation>
HWY_INLINE bool TriangleTest::set(
    const double* pa, const double* pb, const double* pc, double error, const Orientation& orientation) {
    constexpr double kRounding = 0x1p-52; // twice the rounding unit of a double
    double b[3];
    double c[3];
    for (int i = 0; i < 3; ++i) {
        a[i] = pa[i];
        b[i] = pb[i] - pa[i];
        c[i] = pc[i] - pa[i];
    }
    const double sizeB = std::abs(b[0]) + std::abs(b[1]) + std::abs(b[2]);
    const double sizeC = std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]);
    size = std::max(sizeB, sizeC);
    area = b[0] * c[1] - b[1] * c[0];
    normal[0] = b[1] * c[2] - b[2] * c[1];
    normal[1] = b[2] * c[0] - b[0] * c[2];
    edgeError[0] = 2 * (8 * error * size + 24 * error * error + 6 * kRounding * size * size);
    edgeError[1] = 2 * (4 * error + 12 * kRounding * size);
    heightError[0] = 2 * (6 * error * size * size);
    heightError[1] = 2 * (4 * error * size + 8 * error * error + 10 * kRounding * size * size);
    double turn = area < 0 ? -1 : 1;
    if (std::abs(area) <= edgeError[0]) {
        turn = orientation();
        if (turn == 0) return false;
    }
    for (int i = 0; i < 2; ++i) {
        ab[i] = turn * b[i];
        ca[i] = -turn * c[i];
        normal[i] *= turn;
    }
    area *= turn;
    return true;
}

HWY_INLINE void mark(std::uint8_t& status, std::uint8_t bits) {
    std::atomic_ref<std::uint8_t> shared(status);
    if ((shared.load(std::memory_order_relaxed) & bits) != bits) shared.fetch_or(bits, std::memory_order_relaxed);
}

/// Marks a sample as dark, even if other threads write its status. A relaxed store suffices, because the other bits of
/// a dark sample have no meaning.
HWY_INLINE void markDark(std::uint8_t& status) {
    std::atomic_ref<std::uint8_t> shared(status);
    if ((shared.load(std::memory_order_relaxed) & kDark) == 0) shared.store(kDark, std::memory_order_relaxed);
}

/// Calls `visit(lane)` for each SIMD lane that is set in `mask`.
template <class Visit>
HWY_INLINE void forLanes(hn::Mask<DoubleTag> mask, const Visit& visit) {
    alignas(8) std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(kDoubles, mask, bytes);
    for (unsigned bits = bytes[0]; bits != 0; bits &= bits - 1)
        visit(static_cast<std::size_t>(__builtin_ctz(bits)));
}

/// Returns a mask of the SIMD lanes whose samples lie on the triangle with the id `name`. Lane 0 is the sample at index
/// `place`.
HWY_INLINE hn::Mask<DoubleTag> ownLanes(const SampleGrid& grid, std::size_t place, std::uint32_t name) {
    const hn::Rebind<std::uint32_t, DoubleTag> names;
    const auto own = hn::Eq(hn::LoadU(names, &grid.triangle[place]), hn::Set(names, name));
    return hn::MaskFromVec(
        hn::BitCast(kDoubles, hn::PromoteTo(kWides, hn::BitCast(kNarrows, hn::VecFromMask(names, own)))));
}

/// The values that decide whether a triangle shadows a sample, for one sample per SIMD lane. The tolerance of each
/// sample is still to be tested.
struct NearLanes {
    alignas(64) double min[hn::MaxLanes(kDoubles)]; // min of the three edge functions
    alignas(64) double edgeError[hn::MaxLanes(kDoubles)];
    alignas(64) double height[hn::MaxLanes(kDoubles)]; // height of the plane above the sample, times the area
    alignas(64) double heightError[hn::MaxLanes(kDoubles)];

    /// Computes the result of the sample at index `place`, whose values are in SIMD lane `lane`. Calls `resolve(place,
    /// mayCast)` if the sample needs integers.
    template <class Resolve>
    HWY_INLINE void resolveLane(
        const TriangleTest& t,
        const CasterContext& context,
        std::size_t lane,
        std::size_t place,
        const Resolve& resolve) const {
        const SampleList& samples = *context.samples;
        const double tolerance = samples.tolerance[context.grid->source[place]] * samples.perTolerance();
        const double excess = height[lane] - t.area * tolerance;
        const bool covers = min[lane] > edgeError[lane];
        const bool mayCast = excess + heightError[lane] >= 0;
        if (covers && excess > heightError[lane])
            markDark(context.statuses[place]);
        else if (covers && !mayCast && height[lane] > heightError[lane])
            mark(context.statuses[place], kWithinTolerance);
        else
            resolve(place, mayCast);
    }
};

/// Tests the triangle against the samples [begin, end) of the grid, and marks dark samples. Calls `resolve(place,
/// mayCast)` for samples that need integers. `mayCast` is false if the triangle is at most within the tolerance of the
/// sample. If the triangle is farther ahead than the largest tolerance of all samples, the sample is dark at once. Few
/// samples therefore need their own tolerance.
template <class Resolve>
HWY_INLINE void testSamples(
    const TriangleTest& t, const CasterContext& context, std::size_t begin, std::size_t end, const Resolve& resolve) {
    const SampleList& samples = *context.samples;
    const auto tolerance = constant(context.maxTolerance);
    for (std::size_t i = begin; i < end; i += hn::Lanes(kDoubles)) {
        const auto du = hn::Sub(hn::LoadU(kDoubles, &samples.u[i]), constant(t.a[0]));
        const auto dv = hn::Sub(hn::LoadU(kDoubles, &samples.v[i]), constant(t.a[1]));
        const auto first = hn::NegMulAdd(constant(t.ab[1]), du, hn::Mul(constant(t.ab[0]), dv));
        const auto third = hn::NegMulAdd(constant(t.ca[1]), du, hn::Mul(constant(t.ca[0]), dv));
        const auto second = hn::Sub(hn::Sub(constant(t.area), first), third);
        const auto min = hn::Min(hn::Min(first, second), third);
        const auto flatSize = hn::Add(hn::Abs(du), hn::Abs(dv));
        const auto edgeError = hn::MulAdd(flatSize, constant(t.edgeError[1]), constant(t.edgeError[0]));
        const auto isListed = hn::FirstN(kDoubles, end - i);
        const auto mayCover = hn::And(isListed, hn::Ge(hn::Add(min, edgeError), hn::Zero(kDoubles)));
        if (hn::AllFalse(kDoubles, mayCover)) continue;
        const auto dh = hn::Sub(hn::LoadU(kDoubles, &samples.h[i]), constant(t.a[2]));
        const auto size = hn::Add(hn::Add(flatSize, hn::Abs(dh)), tolerance);
        const auto heightError = hn::MulAdd(size, constant(t.heightError[1]), constant(t.heightError[0]));
        const auto below =
            hn::MulAdd(constant(t.normal[0]), du, hn::MulAdd(constant(t.normal[1]), dv, hn::Mul(constant(t.area), dh)));
        const auto height = hn::Neg(below); // height of the plane above the sample, times the area
        const auto mayBeAhead = hn::And(mayCover, hn::Ge(hn::Add(height, heightError), hn::Zero(kDoubles)));
        if (hn::AllFalse(kDoubles, mayBeAhead)) continue;
        const auto excess = hn::NegMulAdd(constant(t.area), tolerance, height);
        // A sample must not be tested against its own triangle, because rounding errors may report a hit at the
        // sample. If a section plane cuts the triangle, the piece with the sample may also extend beyond the triangle.
        const auto mayCast = hn::AndNot(ownLanes(*context.grid, i, t.name), mayBeAhead);
        const auto isDark = hn::And(mayCast, hn::And(hn::Gt(min, edgeError), hn::Gt(excess, heightError)));
        forLanes(isDark, [&](std::size_t lane) { markDark(context.statuses[i + lane]); });
        const auto isOpen = hn::AndNot(isDark, mayCast);
        if (hn::AllFalse(kDoubles, isOpen)) continue;
        NearLanes near; // NOLINT(cppcoreguidelines-pro-type-member-init): stored at once
        hn::Store(min, kDoubles, near.min);
        hn::Store(edgeError, kDoubles, near.edgeError);
        hn::Store(height, kDoubles, near.height);
        hn::Store(heightError, kDoubles, near.heightError);
        forLanes(isOpen, [&](std::size_t lane) { near.resolveLane(t, context, lane, i + lane, resolve); });
    }
}

} // namespace gnomon::exact::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
