// The text that a bench prints: the table of its runs and the recommended settings.
#pragma once

#include "report/recommendation.h"

#include <functional>
#include <optional>
#include <span>
#include <string>

namespace gnomon::bench {

/// Returns a table with a header and one line per run. Sentences that compare the runs follow.
std::string tableText(std::span<const report::RunSummary> summaries);

/// Returns the line of report::recommendationText: the recommended run and the reason. Returns an empty text for a
/// single run without `maxWrongShare`.
std::string recommendationText(std::span<const report::RunSummary> summaries, std::optional<double> maxWrongShare);

/// The answer to a request with a budget.
struct BudgetChoice {
    std::string text; // one line
    bool hasRun = false;
};

/// Returns the result of report::recommendConfirmed. `summaries` must not be empty.
BudgetChoice underBudget(
    const report::Request& request,
    std::span<const report::RunSummary> summaries,
    const std::function<report::RunSummary(std::size_t)>& walkAgain);

/// Returns the options of the fastest run whose aliasing bound is at most `maxAliasing`. Exact shadows have no aliasing
/// and always comply.
std::string underBoundText(double maxAliasing, std::span<const report::RunSummary> summaries);

} // namespace gnomon::bench
