// A baseline: the results of an earlier bench, for comparison with a later bench.
#pragma once

#include "report/run_summary.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace gnomon::bench {

/// The content of a file that `--json-file` wrote.
struct Baseline {
    std::string path;
    std::map<std::string, std::string> context;
    std::map<std::string, double> p50Ms; // median frame time in ms, by the name of the run
};

/// Reads a baseline. Throws Error with the path and the position in the file if the file is not the result of a bench.
/// Throws UsageError if a setting of the baseline has a value that no longer exists.
Baseline readBaseline(const std::string& path);

/// Throws Error if frame times are not comparable, because `context` and the baseline's context differ in one of these:
/// - model, camera path, number of frames, or real-time mode,
/// - view, quality, or memory limits,
/// - backend, or number of threads.
/// A setting that is swept in one of the benches is not compared, because the names of runs contain it.
void requireComparable(const Baseline& baseline, const std::map<std::string, std::string>& context);

/// Returns the names of the runs that are only in the baseline or only in `summaries`, and so cannot be compared.
std::vector<std::string> notCompared(const Baseline& baseline, std::span<const report::RunSummary> summaries);

/// Throws Error if a run was drawn without some pages, because its time is then not comparable. Damaged pages always
/// count. Missing pages count only if `waits` is true, which means that each frame waits for all its pages.
void requireComplete(const Baseline& baseline, std::span<const report::RunSummary> summaries, bool waits);

/// Returns true if the median `nowMs` exceeds `beforeMs` by more than `failAbovePercent` percent.
bool isSlower(double beforeMs, double nowMs, double failAbovePercent);

/// Throws Error if the median of a run exceeds the baseline's median for the same name by more than `failAbovePercent`
/// percent, or if no run has a name of the baseline.
void requireNotSlower(const Baseline& baseline, std::span<const report::RunSummary> summaries, double failAbovePercent);

} // namespace gnomon::bench
