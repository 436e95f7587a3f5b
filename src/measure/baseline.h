// The results of an earlier bench, to hold those of a later one against.
#pragma once

#include "report/run_summary.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace gnomon::measure {

/// What `--json-file` wrote.
struct Baseline {
    std::string path;
    std::map<std::string, std::string> context;
    std::map<std::string, double> p50Ms; // by the names of the runs
};

/// Reads a baseline. Throws Error with path and place.
Baseline readBaseline(const std::string& path);

/// Throws Error where `context` differs from the baseline's in what makes frame times comparable: the model, the path
/// and how it is walked, the view and its quality, the memory, and who drew it with how many threads. A setting that is
/// swept on either side is part of the names of the runs instead.
void requireComparable(const Baseline& baseline, const std::map<std::string, std::string>& context);

/// The names of runs that only one of the baseline and `summaries` has: nothing is compared with them.
std::vector<std::string> notCompared(const Baseline& baseline, std::span<const report::RunSummary> summaries);

/// Throws Error if a run drew without pages, whose time compares with nothing: damaged ones or, where frames wait for
/// all (`waits`), missing ones.
void requireComplete(const Baseline& baseline, std::span<const report::RunSummary> summaries, bool waits);

/// Whether a median grew by more than `failAbovePercent`.
bool isSlower(double beforeMs, double nowMs, double failAbovePercent);

/// Throws Error if a run of the same name in the baseline was faster by more than `failAbovePercent`, or if there is
/// none of any name.
void requireNotSlower(const Baseline& baseline, std::span<const report::RunSummary> summaries, double failAbovePercent);

} // namespace gnomon::measure
