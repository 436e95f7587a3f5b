#include "report/recommendation.h"

#include "report/cited.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <numeric>

namespace gnomon::report {

namespace {

/// Returns the indices of the runs by level of detail: first runsOfOneDetail, then the other levels, finest first.
std::vector<std::vector<std::size_t>> runsByDetail(std::span<const RunSummary> runs) {
    std::map<double, std::vector<std::size_t>> byDetail;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto detail = runs[i].settings.find("error_pixels");
        byDetail[detail == runs[i].settings.end() ? 0 : std::strtod(detail->second.c_str(), nullptr)].push_back(i);
    }
    std::vector<std::vector<std::size_t>> levels;
    levels.reserve(byDetail.size());
    for (auto& [detail, which] : byDetail)
        levels.push_back(std::move(which));
    const auto frequent = std::max_element(
        levels.begin(), levels.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    if (frequent != levels.end()) std::rotate(levels.begin(), frequent, frequent + 1);
    return levels;
}

double fastestMs(std::span<const RunSummary> runs) {
    const std::vector<std::size_t> alike = runsOfOneDetail(runs);
    return std::accumulate(alike.begin(), alike.end(), runs[alike.front()].p50Ms, [&](double ms, std::size_t i) {
        return std::min(ms, runs[i].p50Ms);
    });
}

/// Returns true if `run` takes at most kWorthwhileTimes the time of the fastest run, by the numbers that a sentence
/// cites.
bool isWorthwhile(const RunSummary& run, std::span<const RunSummary> runs) {
    return citedValue(run.p50Ms) <= kWorthwhileTimes * citedValue(fastestMs(runs));
}

bool fulfils(const RunSummary& run, std::span<const RunSummary> runs, const Request& request) {
    const std::optional<double> wrong = wrongPixels(run);
    if (!wrong) return false;
    if (request.budgetMs && timeToExpectMs(run) > *request.budgetMs) return false;
    if (request.maxWrongPixels) return *wrong <= *request.maxWrongPixels;
    return request.budgetMs || isWorthwhile(run, runs);
}

/// Returns the first run of `candidates` that no other one precedes by the order of `request`.
std::optional<std::size_t> bestOf(
    const std::vector<std::size_t>& candidates, std::span<const RunSummary> runs, const Request& request) {
    const auto rank = [&](std::size_t i) {
        const double wrong = *wrongPixels(runs[i]);
        return request.maxWrongPixels ? std::pair(runs[i].p50Ms, wrong) : std::pair(wrong, runs[i].p50Ms);
    };
    const auto best = std::min_element(
        candidates.begin(), candidates.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    return best == candidates.end() ? std::nullopt : std::optional(*best);
}

/// Returns the runs that fulfil `request`, by level of detail in the order of preference. No list is empty.
std::vector<std::vector<std::size_t>> candidatesOf(std::span<const RunSummary> runs, const Request& request) {
    std::vector<std::vector<std::size_t>> levels = runsByDetail(runs);
    if (!request.budgetMs && !request.maxWrongPixels && !levels.empty()) levels.resize(1);
    for (std::vector<std::size_t>& level : levels)
        std::erase_if(level, [&](std::size_t i) { return !fulfils(runs[i], runs, request); });
    std::erase_if(levels, [](const std::vector<std::size_t>& level) { return level.empty(); });
    return levels;
}

/// Returns "with a pixel error of 1 " if `runs` have several levels of detail.
std::string detailInWords(const RunSummary& run, std::span<const RunSummary> runs) {
    const auto detail = run.settings.find("error_pixels");
    if (runsByDetail(runs).size() < 2 || detail == run.settings.end()) return {};
    return "with a pixel error of " + detail->second + " ";
}

/// Returns for example "with at most 0.1% wrong pixels and within 40 ms".
std::string inWords(const Request& request) {
    constexpr int kAllDigits = 15;
    std::string words;
    if (request.maxWrongPixels)
        words = "with at most " + cited(100 * *request.maxWrongPixels, kAllDigits) + "% wrong pixels";
    if (request.budgetMs)
        words += (words.empty() ? "within " : " and within ") + cited(*request.budgetMs, kAllDigits) + " ms";
    return words;
}

} // namespace

bool isExact(const RunSummary& run) {
    return run.settings.contains("cells");
}

std::optional<double> wrongPixels(const RunSummary& run) {
    if (const auto measured = knownError(run, ErrorKind::WrongPixels)) return measured;
    return isExact(run) ? std::optional(0.0) : std::nullopt;
}

std::vector<std::size_t> runsOfOneDetail(std::span<const RunSummary> runs) {
    const std::vector<std::vector<std::size_t>> levels = runsByDetail(runs);
    return levels.empty() ? std::vector<std::size_t>() : levels.front();
}

std::optional<std::size_t> recommend(std::span<const RunSummary> runs, const Request& request) {
    const std::vector<std::vector<std::size_t>> levels = candidatesOf(runs, request);
    return levels.empty() ? std::nullopt : bestOf(levels.front(), runs, request);
}

std::optional<ConfirmedRun> recommendConfirmed(
    std::span<const RunSummary> runs,
    const Request& request,
    const std::function<RunSummary(std::size_t run)>& walkAgain) {
    for (std::vector<std::size_t>& level : candidatesOf(runs, request))
        while (const auto best = bestOf(level, runs, request)) {
            const RunSummary again = walkAgain(*best);
            if (!request.budgetMs || timeToExpectMs(again) <= *request.budgetMs)
                return ConfirmedRun{*best, again.p50Ms};
            std::erase(level, *best);
        }
    return std::nullopt;
}

std::string reasonFor(std::size_t run, std::span<const RunSummary> runs, const Request& request) {
    const RunSummary& chosen = runs[run];
    const double wrong = wrongPixels(chosen).value_or(0);
    const std::string ms = request.budgetMs ? citedBelow(chosen.p50Ms, *request.budgetMs) : cited(chosen.p50Ms);
    if (request.maxWrongPixels)
        return "Of the runs " + detailInWords(chosen, runs) + inWords(request) +
               " it has the shortest frame time: " + ms + " ms, " +
               citedBelow(100 * wrong, 100 * *request.maxWrongPixels) + "% wrong pixels.";
    const std::string which = request.budgetMs
                                  ? inWords(request)
                                  : "that take at most " + cited(kWorthwhileTimes) +
                                        " times the frame time of the fastest run (" + cited(fastestMs(runs)) + " ms)";
    return "Of the runs " + detailInWords(chosen, runs) + which +
           " it has the fewest wrong pixels: " + citedPercent(wrong) + ", " + ms + " ms.";
}

std::string reasonForNone(std::span<const RunSummary> runs, const Request& request) {
    if (std::none_of(runs.begin(), runs.end(), [](const RunSummary& run) { return wrongPixels(run).has_value(); }))
        return "No run is recommended: no run was compared with the ground truth.";
    const std::string wish = inWords(request);
    if (wish.empty())
        return "No run is recommended: no run with known accuracy takes at most " + cited(kWorthwhileTimes) +
               " times the frame time of the fastest run (" + cited(fastestMs(runs)) + " ms).";
    return "No run is recommended: there is no run " + wish + ".";
}

std::string recommendationText(std::span<const RunSummary> runs, const Request& request) {
    const auto run = recommend(runs, request);
    if (!run) return reasonForNone(runs, request);
    const std::string& options = runs[*run].options;
    return "recommended: " + (options.empty() ? "the default options" : options) + ". " +
           reasonFor(*run, runs, request);
}

} // namespace gnomon::report
