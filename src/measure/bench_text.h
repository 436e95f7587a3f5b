// What a bench prints of its runs: the table, the sentences, what budgets and bounds call for, and the changes since a
// baseline.
#pragma once

#include "measure/baseline.h"
#include "report/run_summary.h"

#include <functional>
#include <span>
#include <string>

namespace gnomon::measure {

/// A line a run under a heading, then what a person would say of them and, of several runs, which is recommended.
std::string tableText(std::span<const report::RunSummary> summaries);

/// The setting that the budget calls for, as options to paste; `walkAgain` says whether it keeps it.
std::string underBudgetText(
    double budgetMs,
    std::span<const report::RunSummary> summaries,
    const std::function<report::RunSummary(std::size_t)>& walkAgain);

/// The setting that --max-aliasing calls for, as options to paste.
std::string underBoundText(double maxAliasing, std::span<const report::RunSummary> summaries);

/// A line for each run that the baseline has as well: its median now and then, the change, and whether that passes.
std::string changesText(
    const Baseline& baseline, std::span<const report::RunSummary> summaries, double failAbovePercent);

} // namespace gnomon::measure
