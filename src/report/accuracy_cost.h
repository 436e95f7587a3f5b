// What accuracy costs in time: the Pareto front of a set of runs, and the setting that a budget or a bound calls for.
#pragma once

#include "report/run_summary.h"

#include <cstddef>
#include <functional>
#include <span>

namespace gnomon::report {

/// The error of `run`, if it was measured and is a number.
std::optional<double> knownError(const RunSummary& run, ErrorKind kind);

/// The error that runs are chosen by: the first that all of them know of image difference, the only one that a coarse
/// model raises as a coarse map does, and what `shadowError` asks for.
ErrorKind comparedError(std::span<const RunSummary> runs);

/// The error that a page shows first: wrong pixels, which leave nothing out, if all runs know them, else what
/// `comparedError` says.
ErrorKind leadingError(std::span<const RunSummary> runs);

/// The error that tells maps apart: the first of wrong shadow pixels, edge distance and promise that all runs with maps
/// know. The edge distance comes second because it does not compare from scheme to scheme: a map is held only to the
/// edges that its texels can show, so a coarse map is held to fewer of them; what it misses is among its wrong pixels.
ErrorKind shadowError(std::span<const RunSummary> runs);

/// `a` dominates `b` if it is nowhere worse in median time and error and somewhere better.
/// Runs that do not know the error neither dominate nor are dominated.
bool dominates(const RunSummary& a, const RunSummary& b, ErrorKind kind);

/// What the noise of a run is taken for where it was walked but once.
inline constexpr double kUnknownNoise = 0.1;

/// The median times that a run may have, by its noise.
struct TimeRange {
    double low = 0;
    double high = 0;
};

TimeRange timeRange(const RunSummary& run);

/// Alike: the noise of the two does not let tell which takes longer.
enum class TimeOrder : std::uint8_t { Less, Alike, More };

/// How the time of `a` compares with that of `b`: Less and More only where their ranges do not meet.
TimeOrder compareTimes(const RunSummary& a, const RunSummary& b);

/// The indices of some runs that know the error, fastest first: the most accurate one, and always the next most
/// accurate that is faster by more than noise. Whatever is left out is neither measurably faster than one of them nor
/// more accurate than it.
std::vector<std::size_t> paretoFront(std::span<const RunSummary> runs, ErrorKind kind);

/// How many times the frame time of the fastest run on the front more accuracy may cost to be recommended.
inline constexpr double kWorthwhileTimes = 2;

/// The most accurate run of the front that takes at most kWorthwhileTimes the time of its fastest.
std::optional<std::size_t> recommendedRun(std::span<const RunSummary> runs, ErrorKind kind);

/// The median time that a run may be expected to keep when it is run again: its own, and the noise of it.
double timeToExpectMs(const RunSummary& run);

/// The run of least error whose time to expect is at most `budgetMs`; of equals the fastest; nothing if none is that
/// fast.
std::optional<std::size_t> bestUnderBudget(std::span<const RunSummary> runs, ErrorKind kind, double budgetMs);

/// A run that kept a budget when it was walked again, and its median then.
struct ConfirmedRun {
    std::size_t run = 0;
    double p50MsAgain = 0;
};

/// What `bestUnderBudget` names, if it keeps the budget once more in the summary that `walkAgain(run)` gives, else the
/// next best that does: of many runs the one that looks best owes some of that to luck.
std::optional<ConfirmedRun> confirmedUnderBudget(
    std::span<const RunSummary> runs,
    ErrorKind kind,
    double budgetMs,
    const std::function<RunSummary(std::size_t run)>& walkAgain);

/// The fastest run whose error is at most `bound`; nothing if none is that good.
std::optional<std::size_t> cheapestUnderError(std::span<const RunSummary> runs, ErrorKind kind, double bound);

/// Spearman's rank correlation of two errors over the runs that know both, ties at their mean rank, and the runs that
/// disobey it most.
struct Correlation {
    double rank = 0; // in [-1, 1]; 0 if fewer than three runs know both
    std::size_t runs = 0;
    std::vector<std::size_t> disobedient; // rank in one differs from the other's by more than a third of the runs
};

Correlation correlation(std::span<const RunSummary> runs, ErrorKind a, ErrorKind b);

} // namespace gnomon::report
