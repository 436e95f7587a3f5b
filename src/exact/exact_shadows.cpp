#include "exact/exact_shadows.h"

#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace gnomon::exact {

namespace {

/// The largest coordinate of any caster, cells from the origin.
double reachOf(std::span<const Caster> casters) {
    std::int64_t reach = 1;
    for (const Caster& caster : casters)
        for (int axis = 0; axis < 3; ++axis)
            reach = std::max({reach, -caster.least[axis], caster.most[axis]});
    return static_cast<double>(reach);
}

/// The casters of one round: of each eight neighbours in the list those from `first` to before `end`. What is dark
/// after a round leaves, and with it the clusters that only it called for.
struct Round {
    std::size_t first = 0;
    std::size_t end = 0;
};

constexpr std::size_t kStride = 8;
constexpr std::array kRounds = {Round{0, 1}, Round{1, 4}, Round{4, kStride}};

CastCounts castRound(const CastContext& context, const Round& round) {
    tbb::combinable<CastCounts> counts;
    const std::size_t strides = (context.casters.size() + kStride - 1) / kStride;
    tbb::parallel_for(std::size_t{0}, strides, [&](std::size_t stride) {
        CastCounts& local = counts.local();
        const std::size_t end = std::min(stride * kStride + round.end, context.casters.size());
        for (std::size_t i = stride * kStride + round.first; i < end; ++i)
            castCluster(context, i, local);
    });
    CastCounts sum;
    counts.combine_each([&](const CastCounts& part) { sum += part; });
    return sum;
}

} // namespace

/// Where that is worth the time it takes: a quarter or more of the samples.
void ExactShadows::removeDark() {
    constexpr std::size_t kWorthwhile = 4;
    const auto isDecided = [&](std::size_t place) { return (sorted_[place] & kDark) != 0; };
    std::size_t dark = 0;
    for (std::size_t i = 0; i < grid_.size(); ++i)
        dark += isDecided(i) ? 1 : 0;
    if (dark * kWorthwhile < grid_.size()) return;
    grid_.remove(
        isDecided,
        [&](std::size_t place) { statuses_[grid_.source[place]] = kDark; },
        [&](std::size_t from, std::size_t to) { sorted_[to] = sorted_[from]; });
}

ExactStatistics ExactShadows::decide(const ExactQuestion& question) {
    ExactStatistics statistics;
    statistics.samples = samples_.size();
    const double coordinateError = coordinateErrorFor(reachOf(question.casters));
    grid_.sort(samples_, question.planes, question.side, coordinateError);
    const auto side = static_cast<std::uint64_t>(question.side);
    statistics.cells = side * side * question.planes.size();
    sorted_.assign(samples_.size() + 16, kLit);
    statuses_.resize(samples_.size());
    if (samples_.size() == 0) return statistics;
    const CastContext context{&samples_, &grid_, question.casters, question.originCell, coordinateError, sorted_};
    for (std::size_t round = 0; round < kRounds.size() && grid_.size() > 0; ++round) {
        statistics.cast += castRound(context, kRounds[round]);
        if (round + 1 < kRounds.size()) removeDark();
    }
    for (std::size_t i = 0; i < grid_.size(); ++i)
        statuses_[grid_.source[i]] = (sorted_[i] & kDark) != 0 ? std::uint8_t{kDark} : sorted_[i];
    for (const std::uint8_t status : statuses_) {
        statistics.dark += isDark(status) ? 1 : 0;
        statistics.darkWithoutTolerance += status != kLit ? 1 : 0;
        statistics.touching += status != kLit && status != kDark ? 1 : 0;
    }
    return statistics;
}

} // namespace gnomon::exact
