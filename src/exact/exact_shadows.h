// Exact shadows: tests for each visible point whether a triangle lies between the point and the light. Cells, warps and
// instruction sets only find candidate triangles. Integer arithmetic computes the results, so they do not depend on the
// candidate search (frustum-traced shadows: Wyman, Hoetzlein and Lefohn 2015; alias-free shadow maps: Aila and Laine
// 2004).
#pragma once

#include "exact/caster_kernel.h"

namespace gnomon::exact {

/// The cost and the results of exact shadows for one frame.
struct ExactStatistics {
    std::uint64_t samples = 0; // visible points that face the light, one per pixel
    std::uint64_t cells = 0;   // of all maps
    std::uint64_t dark = 0;
    std::uint64_t darkWithoutTolerance = 0; // number of dark samples if each tolerance were 0
    bool endedEarly = false;                // true: all samples were dark before the last round of casters
    std::uint64_t withinTolerance =
        0; // samples whose result depends on the tolerance or on the rule for ties at an edge
    CasterCounts counts;
};

/// The input of exact shadows for one frame, except the samples.
struct ExactShadowInput {
    std::span<const Caster> casters;    // all possible casters; the clusters on which samples lie come first
    glm::uvec3 originCell{0};           // grid position of the frame's origin
    std::span<const glm::dmat3> planes; // one per map: see SampleGrid::sort
    int side = 512;                     // cells per side of a map
    /// Number of clusters at the end of `casters` that cast no shadow. Samples lie on these clusters.
    std::size_t receiverOnlyClusters = 0;
};

/// Computes exact shadows frame by frame, and reuses its memory.
class ExactShadows {
public:
    /// Returns the list of visible points to test. The caller fills the list before it calls `resolve`.
    SampleList& samples() { return samples_; }

    const SampleList& samples() const { return samples_; }

    /// Tests all samples against all casters, and returns the statistics. Then `statuses` returns the result of each
    /// sample. Runs in the caller's TBB arena.
    ExactStatistics resolve(const ExactShadowInput& input);

    /// Returns the shadow result of each sample as status bits (kLit, kDark, ...), in the order of `samples()`.
    std::span<const std::uint8_t> statuses() const { return {statuses_.begin(), samples_.size()}; }

    const SampleGrid& grid() const { return grid_; }

    /// Returns the peak memory of samples and grid cells over all frames so far, in bytes.
    std::uint64_t bytes() const { return maxSamples_ * kBytesPerSample + grid_.cellBytes(); }

    /// Memory per sample in bytes, including the sample's result.
    static constexpr std::uint64_t kBytesPerSample = SampleList::kBytesPerSample + SampleGrid::kBytesPerSample + 2;

private:
    std::size_t countDark() const;
    void removeDark(std::size_t dark);
    void takeStatuses(ExactStatistics& statistics);

    SampleList samples_;
    SampleGrid grid_;
    FrameArray<std::uint8_t> sorted_;   // statuses in the grid's order
    FrameArray<std::uint8_t> statuses_; // statuses in the order of the samples
    std::size_t maxSamples_ = 0;
};

} // namespace gnomon::exact
