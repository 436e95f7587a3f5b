// The text that a bench prints: the table of its runs and the recommended settings.
#pragma once

#include "report/run_summary.h"

#include <functional>
#include <optional>
#include <span>
#include <string>

namespace gnomon::bench {

/// Returns a table with a header and one line per run. Sentences that compare the runs follow.
std::string tableText(std::span<const report::RunSummary> summaries);

/// Returns the line with the recommended run. With `maxWrongShare`, this is the fastest run with at most this share of
/// wrong pixels. Otherwise it is the most accurate run of the front of time and wrong pixels within twice the time of
/// the fastest. Without a comparison with the ground truth, only a fastest run without wrong pixels is recommended.
/// Returns an empty text for a single run without `maxWrongShare`.
std::string recommendationText(std::span<const report::RunSummary> summaries, std::optional<double> maxWrongShare);

/// The answer to a budget.
struct BudgetChoice {
    std::string text;
    bool hasRun = false;
};

/// Returns the run with the smallest share of wrong pixels whose median frame time is within `budgetMs` twice: in
/// `summaries` and in the second measurement `walkAgain(run)`. If no run has a known share, returns the fastest run.
BudgetChoice underBudget(
    double budgetMs,
    std::span<const report::RunSummary> summaries,
    const std::function<report::RunSummary(std::size_t)>& walkAgain);

/// Returns the options of the fastest run whose aliasing bound is at most `maxAliasing`. Exact shadows have no aliasing
/// and always comply.
std::string underBoundText(double maxAliasing, std::span<const report::RunSummary> summaries);

} // namespace gnomon::bench
