// Boxes of samples against a look at each.
#include "exact/blocks/sample_blocks.h"
#include "tests/exact/random.h"
#include "tests/support/each_target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::exact {
namespace {

/// Samples in heaps: those of a block lie near each other, far from the origin.
void heap(SampleList& samples, RandomWholes& random, std::size_t count) {
    samples.reset({}, count);
    const double far = std::exp2(random.real(0, 21));
    glm::dvec3 heap(0);
    for (std::size_t i = 0; i < count; ++i) {
        if (i % SampleBlocks::kSamples == 0) heap = {random.real(-far, far), random.real(-far, far), far};
        const double spread = random.whole(0, 3) == 0 ? 0 : 1e-3 * far;
        samples.u[i] = heap.x + random.real(-spread, spread);
        samples.v[i] = heap.y + random.real(-spread, spread);
        samples.h[i] = heap.z + random.real(-spread, spread);
    }
}

/// Each sample lies in its block's box, up to a rounding of the doubles that this takes, and the box is no larger than
/// floats make it.
void expectBoxed(const SampleBlocks& blocks, const FrameArray<double>& values, std::size_t axis, std::size_t size) {
    for (std::size_t begin = 0; begin < size; begin += SampleBlocks::kSamples) {
        const std::size_t end = std::min(begin + SampleBlocks::kSamples, size);
        const double middle = blocks.middle[axis][begin / SampleBlocks::kSamples];
        const double half = blocks.half[axis][begin / SampleBlocks::kSamples];
        double farthest = 0;
        double min = values[begin];
        double max = min;
        for (std::size_t i = begin; i < end; ++i) {
            farthest = std::max(farthest, std::abs(values[i] - middle));
            min = std::min(min, values[i]);
            max = std::max(max, values[i]);
        }
        EXPECT_LE(farthest, half * (1 + 0x1p-50));
        EXPECT_LE(half, (0.5 * (max - min) + 0x1p-23 * std::abs(middle)) * (1 + 0x1p-20));
    }
}

TEST(SampleBlocks, HoldTheirSamples) {
    tests::onEachTarget([](const char* target) {
        SCOPED_TRACE(target);
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            SCOPED_TRACE(seed);
            RandomWholes random(seed);
            const auto count = static_cast<std::size_t>(random.whole(1, seed == 0 ? 40000 : 300));
            SampleList samples;
            heap(samples, random, count);
            SampleBlocks blocks;
            // Samples that left lie behind those that are boxed.
            const auto size = static_cast<std::size_t>(random.whole(1, static_cast<std::int64_t>(count)));
            blocks.fit(samples, size);
            expectBoxed(blocks, samples.u, 0, size);
            expectBoxed(blocks, samples.v, 1, size);
            expectBoxed(blocks, samples.h, 2, size);
        }
    });
}

TEST(SampleBlocks, OfNothingAreNone) {
    SampleList samples;
    samples.reset({}, 5);
    SampleBlocks blocks;
    blocks.fit(samples, 0);
    EXPECT_GE(blocks.middle[0].size(), 16U); // can be read all the same
}

} // namespace
} // namespace gnomon::exact
