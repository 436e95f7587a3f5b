#include "exact/exact_shadows.h"

#include <tbb/blocked_range.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>

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

} // namespace

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
    tbb::combinable<CastCounts> counts;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, question.casters.size(), 16),
        [&](const tbb::blocked_range<std::size_t>& part) {
            CastCounts& local = counts.local();
            for (std::size_t i = part.begin(); i < part.end(); ++i)
                castCluster(context, i, local);
        });
    counts.combine_each([&](const CastCounts& part) { statistics.cast += part; });
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const std::uint8_t status = sorted_[i];
        statuses_[grid_.source[i]] = status;
        const bool isDark = (status & kDark) != 0;
        const bool isDarkWithout = (status & kDarkWithoutTolerance) != 0;
        statistics.dark += isDark ? 1 : 0;
        statistics.darkWithoutTolerance += isDarkWithout ? 1 : 0;
        statistics.touching += isDark != isDarkWithout || (status & kOnEdge) != 0 ? 1 : 0;
    }
    return statistics;
}

} // namespace gnomon::exact
