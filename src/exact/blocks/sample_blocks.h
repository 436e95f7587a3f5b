// Boxes around samples that lie side by side in a grid's order, by which a triangle is held against several of them at
// once: most of what its cells hold lies well beside it, or well under it.
#pragma once

#include "exact/sample_list.h"

#include <array>

namespace gnomon::exact {

/// The boxes of samples 0 to 7, 8 to 15 and so on; keeps its memory.
class SampleBlocks {
public:
    static constexpr std::size_t kSamples = 8; // of a block; the last may have less

    /// Boxes the first `size` of `samples`, as they lie now. Runs in the caller's TBB arena; the result does not depend
    /// on the instruction set.
    void fit(const SampleList& samples, std::size_t size);

    /// What the boxes take of memory a sample.
    static constexpr std::uint64_t kBytesPerSample = 6 * sizeof(float) / kSamples;

    // Along u, v and h, cells: a sample is at most `half` off the `middle`. Padded.
    std::array<FrameArray<float>, 3> middle, half;
};

} // namespace gnomon::exact
