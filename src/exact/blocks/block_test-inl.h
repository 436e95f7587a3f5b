// Exact shadows: tests one triangle against boxes of eight adjacent samples, with one box per SIMD lane. The header is
// compiled once per SIMD instruction set.
#if defined(GNOMON_EXACT_BLOCK_TEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_EXACT_BLOCK_TEST_INL_H
#undef GNOMON_EXACT_BLOCK_TEST_INL_H
#else
#define GNOMON_EXACT_BLOCK_TEST_INL_H
#endif

#include "exact/span_test-inl.h"

#include <algorithm>

#include <hwy/cache_control.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::exact::HWY_NAMESPACE {

using BlockTag = hn::CappedTag<float, 16>;
using BlockFloats = hn::Vec<BlockTag>;
constexpr BlockTag kBlockFloats;

HWY_INLINE BlockFloats blockConstant(float value) {
    return hn::Set(kBlockFloats, value);
}

/// Bounds of a linear function over a box of samples, one box per SIMD lane: the value at the middle of the box, and
/// the max deviation from this value.
struct BlockRange {
    BlockFloats middle, reach;

    HWY_INLINE BlockFloats min() const { return hn::Sub(middle, reach); }

    HWY_INLINE BlockFloats max() const { return hn::Add(middle, reach); }
};

/// Tests a triangle against boxes of samples with float arithmetic. The test skips a box, or marks all its samples as
/// dark, only if the result is certain for each sample. All other samples are tested one by one, so boxes change only
/// the speed and not the shadows.
///
/// The error bounds use U = 2^-24. R is the largest absolute coordinate of all corners. s and |d| are as in
/// TriangleTest, with |d| for the farthest corner of the box. A corner's u, v or h is at most 2 R and has an error of 2
/// U R as a float. A difference has an error of 2 U R + U |d|. Coefficients have a relative error of U, and sums of
/// products add three roundings. The edge functions thus have an error of at most s (2 U R + 5 U |d|), plus 2 U s^2
/// from the area. The dot product N . d has an error of s^2 (2 U R + 5 U |d|). The code uses at least three times these
/// bounds, which also covers the errors of doubles.
class BlockTest {
public:
    BlockTest(const TriangleTest& triangle, const CasterContext& context);

    /// Tests one box of samples per SIMD lane; lane i tests box `block` + i. Bit i of `open` is set if the samples of
    /// the box need separate tests. Bit i of `dark` is set if the triangle shadows all samples of the box.
    HWY_INLINE void look(const SampleBlocks& blocks, std::size_t block, unsigned& open, unsigned& dark) const;

private:
    static HWY_INLINE BlockFloats load(const FrameArray<float>& values, std::size_t i) {
        return hn::LoadU(kBlockFloats, &values[i]);
    }

    static HWY_INLINE unsigned bits(hn::Mask<BlockTag> mask) {
        alignas(8) std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(kBlockFloats, mask, bytes);
        return bytes[0] | static_cast<unsigned>(bytes[1]) << 8U;
    }

    float a_[3], ab_[2], bc_[2], ca_[2], normal_[2];
    float area_, tolerance_;
    float edgeError_[2], heightError_[2]; // error of an edge function and of N . d: [0] + [1] * |d|
};

// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): the body sets each member
inline BlockTest::BlockTest(const TriangleTest& triangle, const CasterContext& context) {
    const auto asFloats = [](const double* from, float* to, int count) {
        for (int i = 0; i < count; ++i)
            to[i] = static_cast<float>(from[i]);
    };
    const double bc[2] = {-(triangle.ab[0] + triangle.ca[0]), -(triangle.ab[1] + triangle.ca[1])};
    asFloats(triangle.a, a_, 3);
    asFloats(triangle.ab, ab_, 2);
    asFloats(bc, bc_, 2);
    asFloats(triangle.ca, ca_, 2);
    asFloats(triangle.normal, normal_, 2);
    area_ = static_cast<float>(triangle.area);
    tolerance_ = static_cast<float>(context.maxTolerance);
    constexpr double kRounding = 0x1p-20; // 16 times the rounding unit of a float
    const double size = triangle.size;
    const double corner = kRounding * context.reach / 2;
    edgeError_[0] = static_cast<float>(size * (corner + kRounding * size));
    edgeError_[1] = static_cast<float>(size * kRounding);
    heightError_[0] = static_cast<float>(size * size * (corner + kRounding * context.maxTolerance));
    heightError_[1] = static_cast<float>(size * size * kRounding);
}

HWY_INLINE void BlockTest::look(const SampleBlocks& blocks, std::size_t block, unsigned& open, unsigned& dark) const {
    const auto zero = hn::Zero(kBlockFloats);
    const auto hu = load(blocks.half[0], block);
    const auto hv = load(blocks.half[1], block);
    const auto du = hn::Sub(load(blocks.middle[0], block), blockConstant(a_[0]));
    const auto dv = hn::Sub(load(blocks.middle[1], block), blockConstant(a_[1]));
    const auto flatSize = hn::Add(hn::Add(hn::Abs(du), hu), hn::Add(hn::Abs(dv), hv));
    const auto edgeError = hn::MulAdd(flatSize, blockConstant(edgeError_[1]), blockConstant(edgeError_[0]));
    const auto over = [&](const float* edge) HWY_ATTR {
        return BlockRange{
            hn::NegMulAdd(blockConstant(edge[1]), du, hn::Mul(blockConstant(edge[0]), dv)),
            hn::MulAdd(blockConstant(std::abs(edge[0])), hv, hn::Mul(blockConstant(std::abs(edge[1])), hu))};
    };
    const BlockRange first = over(ab_);
    const BlockRange third = over(ca_);
    BlockRange second = over(bc_);
    second.middle = hn::Add(second.middle, blockConstant(area_));
    const auto maxEdge = hn::Min(hn::Min(first.max(), second.max()), third.max());
    const auto mayCover = hn::Ge(hn::Add(maxEdge, edgeError), zero);
    open = dark = 0;
    if (hn::AllFalse(kBlockFloats, mayCover)) return;
    const auto hh = load(blocks.half[2], block);
    const auto dh = hn::Sub(load(blocks.middle[2], block), blockConstant(a_[2]));
    const auto size = hn::Add(flatSize, hn::Add(hn::Abs(dh), hh));
    const auto heightError = hn::MulAdd(size, blockConstant(heightError_[1]), blockConstant(heightError_[0]));
    const auto area = blockConstant(area_);
    const auto linear = [&](BlockFloats u, BlockFloats v, BlockFloats h, float byU, float byV) HWY_ATTR {
        return hn::MulAdd(blockConstant(byU), u, hn::MulAdd(blockConstant(byV), v, hn::Mul(area, h)));
    };
    const BlockRange height{
        hn::Neg(linear(du, dv, dh, normal_[0], normal_[1])),
        linear(hu, hv, hh, std::abs(normal_[0]), std::abs(normal_[1]))};
    const auto mayBeAhead = hn::And(mayCover, hn::Ge(hn::Add(height.max(), heightError), zero));
    const auto minEdge = hn::Min(hn::Min(first.min(), second.min()), third.min());
    const auto excess = hn::NegMulAdd(area, blockConstant(tolerance_), height.min());
    const auto isDark = hn::And(hn::Gt(minEdge, edgeError), hn::Gt(excess, heightError));
    open = bits(hn::AndNot(isDark, mayBeAhead));
    dark = bits(hn::And(isDark, mayBeAhead));
}

/// Returns true if one of the samples [begin, end) lies on the triangle with the id `name`.
HWY_INLINE bool holdsOwn(const CasterContext& context, std::size_t begin, std::size_t end, std::uint32_t name) {
    unsigned found = 0;
    for (std::size_t i = begin; i < end; ++i)
        found |= context.grid->triangle[i] == name ? 1U : 0U;
    return found != 0;
}

HWY_INLINE void prefetchSamples(const CasterContext& context, std::size_t place) {
    hwy::Prefetch(&context.samples->u[place]);
    hwy::Prefetch(&context.samples->v[place]);
    hwy::Prefetch(&context.samples->h[place]);
}

/// Tests triangle `t` against the samples [begin, end). The function first tests boxes of eight samples with `test`.
/// Then it tests the samples of undecided boxes one by one, like testSamples. `test` must be prepared from `t`.
template <class Resolve>
HWY_INLINE void testBlocks(
    const BlockTest& test,
    const TriangleTest& t,
    const CasterContext& context,
    std::size_t begin,
    std::size_t end,
    const Resolve& resolve) {
    constexpr std::size_t kSamples = SampleBlocks::kSamples;
    const std::size_t last = (end + kSamples - 1) / kSamples;
    for (std::size_t block = begin / kSamples; block < last; block += hn::Lanes(kBlockFloats)) {
        unsigned open = 0;
        unsigned dark = 0;
        test.look(context.grid->blocks(), block, open, dark);
        const auto listed = static_cast<unsigned>((std::size_t{1} << std::min<std::size_t>(last - block, 16)) - 1);
        for (unsigned left = open & listed; left != 0; left &= left - 1)
            prefetchSamples(context, (block + static_cast<std::size_t>(__builtin_ctz(left))) * kSamples);
        for (unsigned left = (open | dark) & listed; left != 0; left &= left - 1) {
            const auto lane = static_cast<std::size_t>(__builtin_ctz(left));
            const std::size_t from = std::max(begin, (block + lane) * kSamples);
            const std::size_t to = std::min(end, (block + lane + 1) * kSamples);
            if ((dark >> lane & 1U) == 0 || holdsOwn(context, from, to, t.name))
                testSamples(t, context, from, to, resolve);
            else
                for (std::size_t i = from; i < to; ++i)
                    markDark(context.statuses[i]);
        }
    }
}

} // namespace gnomon::exact::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
