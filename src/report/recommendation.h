// The recommended run of a bench. The text of `bench` and the report use this rule.
#pragma once

#include "report/accuracy_cost.h"
#include "report/run_summary.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::report {

/// Returns true if `run` draws exact shadows.
bool isExact(const RunSummary& run);

/// Returns the measure of accuracy of all sentences, plots and recommendations: the share of wrong pixels in all
/// pixels, from 0 to 1. It is 0 for exact shadows that were not compared with a ground truth. Returns nullopt for other
/// runs that were not compared.
std::optional<double> wrongPixels(const RunSummary& run);

/// Returns the indices of the runs with the same level of detail: the most frequent value of `error_pixels`, and the
/// smallest of equally frequent values. Wrong pixels are counted against a run's own triangles, so they do not compare
/// a coarse model with a fine model.
std::vector<std::size_t> runsOfOneDetail(std::span<const RunSummary> runs);

/// The limits that a user requests. A recommended run keeps both.
struct Request {
    std::optional<double> maxWrongPixels{}; // share of all pixels, from 0 to 1
    std::optional<double> budgetMs{};       // limit of `timeToExpectMs`
};

/// Max ratio of the recommended run's frame time to that of the fastest run.
inline constexpr double kWorthwhileTimes = 2;

/// Returns the recommended run, or nullopt if no run with known `wrongPixels` fulfils `request`:
/// - with `maxWrongPixels`: the run with the smallest median frame time;
/// - with `budgetMs` only: the run with the fewest wrong pixels;
/// - without a request: the run with the fewest wrong pixels of those that take at most kWorthwhileTimes the median
///   frame time of the fastest run.
/// Among equal runs it is the better in the other value, then the first. All candidates have one level of detail: that
/// of `runsOfOneDetail`, or if none of these runs fulfils `request`, the finest of the other levels with such a run.
std::optional<std::size_t> recommend(std::span<const RunSummary> runs, const Request& request = {});

/// A run that was within the budget when it was measured again, with its second median time.
struct ConfirmedRun {
    std::size_t run = 0;
    double p50MsAgain = 0;
};

/// Returns the result of `recommend` for a request with a budget if a second measurement `walkAgain(run)` is also
/// within the budget. Otherwise tries the next run. This is necessary because the apparent best of many runs is partly
/// luck.
std::optional<ConfirmedRun> recommendConfirmed(
    std::span<const RunSummary> runs,
    const Request& request,
    const std::function<RunSummary(std::size_t run)>& walkAgain);

/// Returns the reason for recommending `run` as one sentence with its time and accuracy, for example "Of the runs with
/// at most 0.1% wrong pixels it has the shortest frame time: 30.7 ms, 0% wrong pixels." `run` is the result of
/// `recommend` or `recommendConfirmed`.
std::string reasonFor(std::size_t run, std::span<const RunSummary> runs, const Request& request = {});

/// Returns why `recommend` has no result, as one sentence.
std::string reasonForNone(std::span<const RunSummary> runs, const Request& request = {});

/// Returns one line: "recommended: OPTIONS. REASON", or `reasonForNone`.
std::string recommendationText(std::span<const RunSummary> runs, const Request& request = {});

} // namespace gnomon::report
