#include "exact/exact_shadows.h"

#include <tbb/blocked_range.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <functional>

namespace gnomon::exact {

namespace {

/// Returns the largest absolute coordinate of all casters, in cells from the frame's origin.
double reachOf(std::span<const Caster> casters) {
    std::int64_t reach = 1;
    for (const Caster& caster : casters)
        for (int axis = 0; axis < 3; ++axis)
            reach = std::max({reach, -caster.min[axis], caster.max[axis]});
    return static_cast<double>(reach);
}

/// A round tests only some casters against the samples: in each group of eight adjacent casters of the list, the
/// casters `first` to `end` - 1. After a round, dark samples can be removed. Later rounds then skip clusters that could
/// shadow only removed samples.
struct Round {
    std::size_t first = 0;
    std::size_t end = 0;
};

constexpr std::size_t kGrain = 16384; // samples
constexpr std::size_t kStride = 8;
constexpr std::array kRounds = {Round{0, 1}, Round{1, 4}, Round{4, kStride}};
// Min ratio of dark samples to remaining samples at which dark samples are removed from the grid.
constexpr double kWorthwhile = 0.25;

/// Returns true if the caster has vertices and thus casts shadows. Casters without vertices only contain triangles on
/// which samples lie.
bool castsAnything(const Caster& caster) {
    return caster.geometry.vertexCount > 0;
}

/// Tests the clusters of `round` among the first `casting` casters against the samples. Returns the counts of this
/// work.
CasterCounts rasterizeRound(const CasterContext& context, std::size_t casting, const Round& round) {
    tbb::combinable<CasterCounts> counts;
    const std::size_t strides = (casting + kStride - 1) / kStride;
    tbb::parallel_for(std::size_t{0}, strides, [&](std::size_t stride) {
        CasterCounts& local = counts.local();
        const std::size_t end = std::min(stride * kStride + round.end, casting);
        for (std::size_t i = stride * kStride + round.first; i < end; ++i)
            if (castsAnything(context.casters[i])) rasterizeCluster(context, i, local);
    });
    CasterCounts sum;
    counts.combine_each([&](const CasterCounts& part) { sum += part; });
    return sum;
}

/// Divides [0, size) into ranges, calls `sumOf(begin, end)` for each range in parallel, and returns the sum of the
/// results.
template <class SumOf>
std::size_t sumOver(std::size_t size, const SumOf& sumOf) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, size, kGrain),
        std::size_t{0},
        [&](const auto& range, std::size_t sum) { return sum + sumOf(range.begin(), range.end()); },
        std::plus<>());
}

/// Returns the largest tolerance of all samples, as a distance in cells along h.
double maxTolerance(const SampleList& samples) {
    const std::uint32_t maxSteps = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, samples.size(), kGrain),
        0U,
        [&](const auto& range, std::uint32_t largest) {
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                largest = std::max(largest, samples.tolerance[i]);
            return largest;
        },
        [](std::uint32_t a, std::uint32_t b) { return std::max(a, b); });
    return maxSteps * samples.perTolerance();
}

} // namespace

std::size_t ExactShadows::countDark() const {
    return sumOver(grid_.size(), [&](std::size_t begin, std::size_t end) {
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i)
            count += (sorted_[i] & kDark) != 0 ? 1 : 0;
        return count;
    });
}

/// Removes the dark samples from the grid. If their number `dark` is too small to save time, the function does nothing.
void ExactShadows::removeDark(std::size_t dark) {
    if (static_cast<double>(dark) < kWorthwhile * static_cast<double>(grid_.size())) return;
    const auto isResolved = [&](std::size_t place) { return (sorted_[place] & kDark) != 0; };
    grid_.remove(samples_, sorted_, isResolved, [&](std::size_t place) { statuses_[grid_.source[place]] = kDark; });
}

/// Copies the results of the samples that are still in the grid, and counts the samples per result.
void ExactShadows::takeStatuses(ExactStatistics& statistics) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grid_.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            statuses_[grid_.source[i]] = (sorted_[i] & kDark) != 0 ? std::uint8_t{kDark} : sorted_[i];
    });

    struct Counts {
        std::uint64_t dark = 0;
        std::uint64_t notLit = 0;
        std::uint64_t withinTolerance = 0;
    };

    const Counts counts = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, samples_.size(), kGrain),
        Counts(),
        [&](const auto& range, Counts sum) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                sum.dark += isDark(statuses_[i]) ? 1 : 0;
                sum.notLit += statuses_[i] != kLit ? 1 : 0;
                sum.withinTolerance += (statuses_[i] & ~kDark) != 0 ? 1 : 0;
            }
            return sum;
        },
        [](const Counts& a, const Counts& b) {
            return Counts{a.dark + b.dark, a.notLit + b.notLit, a.withinTolerance + b.withinTolerance};
        });
    statistics.dark = counts.dark;
    statistics.darkWithoutTolerance = counts.notLit;
    statistics.withinTolerance = counts.withinTolerance;
}

ExactStatistics ExactShadows::resolve(const ExactShadowInput& input) {
    ExactStatistics statistics;
    statistics.samples = samples_.size();
    maxSamples_ = std::max(maxSamples_, samples_.size());
    const double reach = reachOf(input.casters);
    const double coordinateError = coordinateErrorFor(reach);
    grid_.sort(samples_, input.planes, input.side, coordinateError);
    const auto side = static_cast<std::uint64_t>(input.side);
    statistics.cells = side * side * grid_.maps().size();
    if (samples_.size() == 0) return statistics;
    sorted_.ensureCapacity(samples_.room());
    statuses_.ensureCapacity(samples_.room());
    std::fill(&sorted_[0], &sorted_[samples_.size()], kLit);
    const CasterContext context{
        &samples_,
        &grid_,
        input.casters,
        input.originCell,
        reach,
        coordinateError,
        maxTolerance(samples_),
        {&sorted_[0], samples_.size()}};
    for (std::size_t round = 0; round < kRounds.size(); ++round) {
        statistics.endedEarly = grid_.size() == 0;
        if (statistics.endedEarly) break;
        statistics.counts += rasterizeRound(context, input.casters.size() - input.receiverOnlyClusters, kRounds[round]);
        if (round + 1 == kRounds.size()) break;
        removeDark(countDark());
    }
    takeStatuses(statistics);
    return statistics;
}

} // namespace gnomon::exact
