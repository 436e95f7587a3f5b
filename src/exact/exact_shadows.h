// Exact shadows: for each visible point whether a triangle stands between it and the light, decided once, by the same
// integers whatever cells, warps and instruction sets found the triangles to ask (frustum-traced shadows: Wyman,
// Hoetzlein and Lefohn 2015; alias-free shadow maps: Aila and Laine 2004).
#pragma once

#include "exact/caster_kernel.h"

namespace gnomon::exact {

/// What a frame's decisions took and found.
struct ExactStatistics {
    std::uint64_t samples = 0; // pixels that face the light
    std::uint64_t cells = 0;   // of all maps
    std::uint64_t dark = 0;
    std::uint64_t darkWithoutTolerance = 0; // were every tolerance 0
    bool endedEarly = false;                // all samples were dark before the last round of casters
    std::uint64_t touching = 0; // samples whose verdict hangs on the tolerance, or on the rule for ties at an edge
    CastCounts cast;
};

/// What is to be decided, besides the samples.
struct ExactQuestion {
    std::span<const Caster> casters;    // all that can cast; first those that samples name their triangles by
    glm::uvec3 originCell{0};           // of the grid: the frame's origin
    std::span<const glm::dmat3> planes; // a map each: see SampleGrid::sort
    int side = 512;                     // cells of a map, on each side
    std::size_t holders = 0;            // the last so many casters only hold samples, and cast nothing
};

/// Decides the samples of one frame after another; keeps its memory.
class ExactShadows {
public:
    /// To be filled for a frame before `decide`.
    SampleList& samples() { return samples_; }

    const SampleList& samples() const { return samples_; }

    /// Answers what it took. Runs in the caller's TBB arena.
    ExactStatistics decide(const ExactQuestion& question);

    /// What came out, by the order of `samples()`: bits of their statuses.
    std::span<const std::uint8_t> statuses() const { return {statuses_.begin(), samples_.size()}; }

    const SampleGrid& grid() const { return grid_; }

    /// What the samples and their cells take: those of the frame that had most of them.
    std::uint64_t bytes() const { return mostSamples_ * kBytesPerSample + grid_.cellBytes(); }

    /// What a sample takes, with its statuses.
    static constexpr std::uint64_t kBytesPerSample = SampleList::kBytesPerSample + SampleGrid::kBytesPerSample + 2;

private:
    std::size_t countDark() const;
    void removeDark(std::size_t dark);
    void takeStatuses(ExactStatistics& statistics);

    SampleList samples_;
    SampleGrid grid_;
    FrameArray<std::uint8_t> sorted_;   // statuses in the grid's order
    FrameArray<std::uint8_t> statuses_; // in that of the samples
    std::size_t mostSamples_ = 0;
};

} // namespace gnomon::exact
