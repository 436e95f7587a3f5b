#include "bench/bench_text.h"

#include "core/formatted.h"
#include "report/accuracy_cost.h"
#include "report/sentences.h"
#include "settings/codec.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <tuple>
#include <vector>

namespace gnomon::bench {

namespace {

using report::ErrorKind;
using report::RunSummary;

/// Returns `name` with spaces up to the width of a column. A longer name stays as it is.
std::string padded(const std::string& name) {
    constexpr std::size_t kColumn = 52;
    return name + std::string(name.size() < kColumn ? kColumn - name.size() : 0, ' ');
}

/// Returns an error in a column, or "-" if it is unknown.
std::string column(const RunSummary& run, ErrorKind kind, const char* format, double scale = 1) {
    const auto value = report::knownError(run, kind);
    if (!value) return "-";
    std::array<char, 64> text{};
    // NOLINTNEXTLINE(clang-diagnostic-format-nonliteral): the formats are literals of this file
    std::snprintf(text.data(), text.size(), format, scale * *value);
    return text.data();
}

/// Returns the figures of a run: "(31 ms, 0.41% wrong pixels)".
std::string figuresOf(const RunSummary& run) {
    const auto wrong = report::knownError(run, ErrorKind::WrongPixels);
    return formatted("(%.4g ms, ", run.p50Ms) +
           (!wrong       ? "wrong pixels not measured"
            : *wrong > 0 ? formatted("%.3g%% wrong pixels", 100 * *wrong)
                         : "no wrong pixels") +
           ")";
}

bool isKnown(const RunSummary& run) {
    return report::knownError(run, ErrorKind::WrongPixels).has_value();
}

std::size_t fastest(std::span<const RunSummary> summaries) {
    const auto place = std::min_element(
        summaries.begin(), summaries.end(), [](const RunSummary& a, const RunSummary& b) { return a.p50Ms < b.p50Ms; });
    return static_cast<std::size_t>(place - summaries.begin());
}

std::string recommended(const RunSummary& run) {
    return "recommended: " + run.options + " " + figuresOf(run) + "\n";
}

/// Returns the run with the smallest share of wrong pixels, which must be known for some run.
const RunSummary& mostAccurate(std::span<const RunSummary> summaries) {
    const auto rank = [](const RunSummary& run) {
        const auto wrong = report::knownError(run, ErrorKind::WrongPixels);
        return std::tuple(!wrong.has_value(), wrong.value_or(0), run.p50Ms);
    };
    return *std::min_element(summaries.begin(), summaries.end(), [&](const RunSummary& a, const RunSummary& b) {
        return rank(a) < rank(b);
    });
}

} // namespace

std::string tableText(std::span<const RunSummary> summaries) {
    std::string table = padded("run") + formatted(
                                            " %9s %9s %9s %6s %13s %8s %9s\n",
                                            "p50 ms",
                                            "p95 ms",
                                            "p99 ms",
                                            "maps",
                                            "wrong pixels",
                                            "bound",
                                            "edge px");
    for (const RunSummary& s : summaries)
        table += padded(s.name) + formatted(
                                      " %9.2f %9.2f %9.2f %6d %13s %8s %9s\n",
                                      s.p50Ms,
                                      s.p95Ms,
                                      s.p99Ms,
                                      s.shadowMaps,
                                      column(s, ErrorKind::WrongPixels, "%.3g%%", 100).c_str(),
                                      column(s, ErrorKind::AliasingBound, "%.3g").c_str(),
                                      column(s, ErrorKind::ShadowEdge, "%.3g").c_str());
    for (const std::string& sentence : report::sentences(summaries))
        table += sentence + "\n";
    return table;
}

std::string recommendationText(std::span<const RunSummary> summaries, std::optional<double> maxWrongShare) {
    if (summaries.empty() || (summaries.size() < 2 && !maxWrongShare)) return {};
    if (maxWrongShare) {
        const auto choice = report::cheapestUnderError(summaries, ErrorKind::WrongPixels, *maxWrongShare);
        if (choice) return recommended(summaries[*choice]);
        if (std::none_of(summaries.begin(), summaries.end(), isKnown))
            return "no recommendation: no run was compared with the ground truth\n";
        const RunSummary& best = mostAccurate(summaries);
        return formatted("no run has at most %.3g%% wrong pixels; the most accurate run is ", 100 * *maxWrongShare) +
               best.options + " " + figuresOf(best) + "\n";
    }
    const RunSummary& first = summaries[fastest(summaries)];
    if (report::knownError(first, ErrorKind::WrongPixels).value_or(1) <= 0) return recommended(first);
    const auto unknown =
        std::count_if(summaries.begin(), summaries.end(), [](const RunSummary& run) { return !isKnown(run); });
    if (unknown > 0)
        return formatted(
            "no recommendation: %lld of %zu runs were not compared with the ground truth\n",
            static_cast<long long>(unknown),
            summaries.size());
    const auto choice = report::recommendedRun(summaries, ErrorKind::WrongPixels);
    return choice ? recommended(summaries[*choice]) : std::string();
}

BudgetChoice underBudget(
    double budgetMs, std::span<const RunSummary> summaries, const std::function<RunSummary(std::size_t)>& walkAgain) {
    std::vector<RunSummary> runs(summaries.begin(), summaries.end());
    const bool isMeasured = std::any_of(runs.begin(), runs.end(), isKnown);
    if (!isMeasured)
        for (RunSummary& run : runs)
            run.errors[ErrorKind::WrongPixels] = 0; // then the fastest run wins
    const std::string question = isMeasured
                                     ? formatted("least wrong pixels within %g ms: ", budgetMs)
                                     : formatted("least time within %g ms (wrong pixels not measured): ", budgetMs);
    const auto choice = report::confirmedUnderBudget(runs, ErrorKind::WrongPixels, budgetMs, walkAgain);
    if (!choice)
        return {
            question + formatted("no run; the fastest needs %.4g ms\n", summaries[fastest(summaries)].p50Ms), false};
    const RunSummary& run = summaries[choice->run];
    return {
        question + run.options + " " + figuresOf(run) +
            formatted(", %.4g ms in a second measurement\n", choice->p50MsAgain),
        true};
}

std::string underBoundText(double maxAliasing, std::span<const RunSummary> summaries) {
    const std::string question = "fastest with an aliasing bound of at most " + settings::shortest(maxAliasing) + ": ";
    std::vector<RunSummary> runs(summaries.begin(), summaries.end());
    for (RunSummary& run : runs)
        if (run.settings.contains("cells")) run.errors[ErrorKind::AliasingBound] = 0;
    const auto choice = report::cheapestUnderError(runs, ErrorKind::AliasingBound, maxAliasing);
    if (!choice) return question + "no run\n";
    return question + summaries[*choice].options + formatted(" (%.4g ms)\n", summaries[*choice].p50Ms);
}

} // namespace gnomon::bench
