// Bounding boxes of groups of eight adjacent samples of exact shadows. One test of a triangle against a box often
// replaces eight sample tests, because most samples are clearly beside the triangle or behind it.
#pragma once

#include "exact/sample_list.h"

#include <array>

namespace gnomon::exact {

/// The bounding boxes of samples 0 to 7, 8 to 15 and so on. The object reuses its memory between frames.
class SampleBlocks {
public:
    static constexpr std::size_t kSamples = 8; // samples per box; the last box may have fewer

    /// Computes the bounding boxes of the first `size` samples of `samples`, in their current order. Runs in the
    /// caller's TBB arena. The result does not depend on the instruction set.
    void fit(const SampleList& samples, std::size_t size);

    /// Memory of the boxes in bytes, divided by the number of samples.
    static constexpr std::uint64_t kBytesPerSample = 6 * sizeof(float) / kSamples;

    // Middles and half extents of the boxes along u, v and h, in grid cells. The distance of each sample from `middle`
    // is at most `half`. The arrays are padded to whole SIMD vectors.
    std::array<FrameArray<float>, 3> middle, half;
};

} // namespace gnomon::exact
