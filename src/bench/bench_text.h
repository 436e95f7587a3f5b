// The text that a bench prints: the table of its runs, recommended settings, and changes since a baseline.
#pragma once

#include "bench/baseline.h"
#include "report/run_summary.h"

#include <functional>
#include <span>
#include <string>

namespace gnomon::bench {

/// Returns a table with a header and one line per run. Sentences that compare the runs follow. If there are several
/// runs, the last line is the recommended run.
std::string tableText(std::span<const report::RunSummary> summaries);

/// Returns the options of the run with the smallest error whose median frame time is within `budgetMs` twice: in
/// `summaries` and in the second measurement `walkAgain(run)`.
std::string underBudgetText(
    double budgetMs,
    std::span<const report::RunSummary> summaries,
    const std::function<report::RunSummary(std::size_t)>& walkAgain);

/// Returns the options of the fastest run whose aliasing bound is at most `maxAliasing`.
std::string underBoundText(double maxAliasing, std::span<const report::RunSummary> summaries);

/// Returns one line per run that is also in the baseline: both medians in ms, the change in percent, and whether the
/// change is at most `failAbovePercent`.
std::string changesText(
    const Baseline& baseline, std::span<const report::RunSummary> summaries, double failAbovePercent);

} // namespace gnomon::bench
