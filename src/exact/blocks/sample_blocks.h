// Boxes around adjacent samples of the sample grid. One test of a triangle against a box replaces the tests against all
// its samples. Most samples in the cells of a triangle are clearly beside the triangle, or clearly behind it as seen
// from the light.
#pragma once

#include "exact/sample_list.h"

#include <array>

namespace gnomon::exact {

/// The boxes of samples 0 to 7, 8 to 15 and so on. The object reuses its memory between frames.
class SampleBlocks {
public:
    static constexpr std::size_t kSamples = 8; // samples per block; the last block may have fewer

    /// Computes the boxes of the first `size` of `samples`, in their current order. Runs in the caller's TBB arena. The
    /// result does not depend on the instruction set.
    void fit(const SampleList& samples, std::size_t size);

    /// The memory of the boxes per sample, in bytes.
    static constexpr std::uint64_t kBytesPerSample = 6 * sizeof(float) / kSamples;

    // Middles and half extents of the boxes along u, v and h, in grid cells. Each sample is within `half` of `middle`.
    // The arrays are padded.
    std::array<FrameArray<float>, 3> middle, half;
};

} // namespace gnomon::exact
