// The trade-off between accuracy and time: the Pareto front of a set of runs, and the fastest run within an error
// bound.
#pragma once

#include "report/run_summary.h"

#include <cstddef>
#include <functional>
#include <span>

namespace gnomon::report {

/// Returns the error of `run` if it was measured and is finite.
std::optional<double> knownError(const RunSummary& run, ErrorKind kind);

/// Returns the error that a page shows first: wrong pixels, the measure of accuracy, if a run has them. Otherwise
/// returns the aliasing bound.
ErrorKind leadingError(std::span<const RunSummary> runs);

/// Returns the error for comparing maps: the first of wrong shadow pixels, edge distance and aliasing bound that all
/// runs with maps have. The edge distance comes second because it is not comparable between schemes. It covers only
/// edges that the texels of a map can represent, so fewer edges for a coarse map. The missed edges count among the
/// wrong pixels.
ErrorKind shadowError(std::span<const RunSummary> runs);

/// Returns true if `a` dominates `b`: it is not worse in median time and error, and better in one of them. A run
/// without the error neither dominates nor is dominated.
bool dominates(const RunSummary& a, const RunSummary& b, ErrorKind kind);

/// The assumed noise of a run that was measured only once.
inline constexpr double kUnknownNoise = 0.1;

/// The range of a run's median time, given its noise.
struct TimeRange {
    double low = 0;
    double high = 0;
};

TimeRange timeRange(const RunSummary& run);

/// The order of two times. Alike means that the difference is within the noise.
enum class TimeOrder : std::uint8_t { Less, Alike, More };

/// Compares the times of `a` and `b`. The result is Less or More only if their ranges are disjoint.
TimeOrder compareTimes(const RunSummary& a, const RunSummary& b);

/// Returns the indices of the runs on the Pareto front, fastest first. It starts with the most accurate run, and
/// repeatedly adds the next most accurate run that is faster beyond the noise. For each omitted run, the front contains
/// a run that is at least as accurate and not measurably slower. Runs without the error are ignored.
std::vector<std::size_t> paretoFront(std::span<const RunSummary> runs, ErrorKind kind);

/// Returns the expected upper limit of a run's median time when it is measured again: its median plus its noise.
double timeToExpectMs(const RunSummary& run);

/// Returns the fastest run whose error is at most `bound`, or nullopt.
std::optional<std::size_t> cheapestUnderError(std::span<const RunSummary> runs, ErrorKind kind, double bound);

/// Spearman's rank correlation of two errors over the runs that have both, with ties at their mean rank. Also lists the
/// runs that deviate most.
struct Correlation {
    double rank = 0; // in [-1, 1]; 0 for fewer than three runs
    std::size_t runs = 0;
    std::vector<std::size_t> outliers; // runs whose two ranks differ by more than a third of the number of runs
};

Correlation correlation(std::span<const RunSummary> runs, ErrorKind a, ErrorKind b);

} // namespace gnomon::report
