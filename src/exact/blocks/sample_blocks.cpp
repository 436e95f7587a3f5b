#include "exact/blocks/sample_blocks.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "exact/blocks/sample_blocks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::exact::HWY_NAMESPACE {

/// Computes the bounding boxes of adjacent groups of eight samples along one axis. Each group must be full.
void boxWholeBlocksInLanes(const double* values, std::size_t blocks, float* middle, float* half) {
    namespace hn = hwy::HWY_NAMESPACE;
    constexpr float kUp = 1 + 0x1p-22F; // larger than the rounding error of a conversion to float
    const hn::CappedTag<double, 4> tag; // reductions of short vectors need fewer steps
    for (std::size_t b = 0; b < blocks; ++b, values += SampleBlocks::kSamples) {
        auto low = hn::LoadU(tag, values);
        auto high = low;
        for (std::size_t i = hn::Lanes(tag); i < SampleBlocks::kSamples; i += hn::Lanes(tag)) {
            const auto more = hn::LoadU(tag, values + i);
            low = hn::Min(low, more);
            high = hn::Max(high, more);
        }
        const double minValue = hn::GetLane(hn::MinOfLanes(tag, low));
        const double maxValue = hn::GetLane(hn::MaxOfLanes(tag, high));
        middle[b] = static_cast<float>(0.5 * (minValue + maxValue));
        half[b] = static_cast<float>(std::max(maxValue - middle[b], middle[b] - minValue)) * kUp;
    }
}

} // namespace gnomon::exact::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::exact {

HWY_EXPORT(boxWholeBlocksInLanes);

void SampleBlocks::fit(const SampleList& samples, std::size_t size) {
    constexpr std::size_t kPadding = 16;
    constexpr std::size_t kGrain = 2048; // blocks
    const std::size_t whole = size / kSamples;
    const std::array axes = {&samples.u, &samples.v, &samples.h};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const FrameArray<double>& values = *axes[axis];
        middle[axis].ensureCapacity(samples.room() / kSamples + kPadding);
        half[axis].ensureCapacity(samples.room() / kSamples + kPadding);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, whole, kGrain), [&](const auto& range) {
            const std::size_t b = range.begin();
            HWY_DYNAMIC_DISPATCH(boxWholeBlocksInLanes)
            (&values[b * kSamples], range.size(), &middle[axis][b], &half[axis][b]);
        });
        if (whole * kSamples == size) continue;
        std::array<double, kSamples> rest{};
        rest.fill(values[whole * kSamples]);
        std::copy(&values[whole * kSamples], &values[size], rest.begin());
        HWY_DYNAMIC_DISPATCH(boxWholeBlocksInLanes)(rest.data(), 1, &middle[axis][whole], &half[axis][whole]);
    }
}

} // namespace gnomon::exact
#endif
