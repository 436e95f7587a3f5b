#include "bench/bench_text.h"

#include "core/formatted.h"
#include "report/accuracy_cost.h"
#include "report/sentences.h"
#include "settings/codec.h"

namespace gnomon::bench {

namespace {

/// Returns `name` with spaces up to the width of a column. A longer name stays as it is.
std::string padded(const std::string& name) {
    constexpr std::size_t kColumn = 52;
    return name + std::string(name.size() < kColumn ? kColumn - name.size() : 0, ' ');
}

} // namespace

std::string tableText(std::span<const report::RunSummary> summaries) {
    std::string table =
        padded("run") + formatted(" %9s %9s %9s %6s %10s\n", "p50 ms", "p95 ms", "p99 ms", "maps", "promise");
    for (const report::RunSummary& s : summaries) {
        const auto bound = report::knownError(s, report::ErrorKind::AliasingBound);
        const std::string aliasingBound = bound ? formatted("%.3g", *bound) : "-";
        table +=
            padded(s.name) +
            formatted(" %9.2f %9.2f %9.2f %6d %10s\n", s.p50Ms, s.p95Ms, s.p99Ms, s.shadowMaps, aliasingBound.c_str());
    }
    for (const std::string& sentence : report::sentences(summaries))
        table += sentence + "\n";
    const report::ErrorKind kind = report::comparedError(summaries);
    const auto choice = report::recommendedRun(summaries, kind);
    if (summaries.size() > 1 && choice)
        table += "recommended: " + summaries[*choice].options + formatted(" (%.4g ms, ", summaries[*choice].p50Ms) +
                 std::string(report::label(kind)) +
                 formatted(": %.2g)\n", *report::knownError(summaries[*choice], kind));
    return table;
}

std::string underBudgetText(
    double budgetMs,
    std::span<const report::RunSummary> summaries,
    const std::function<report::RunSummary(std::size_t)>& walkAgain) {
    const report::ErrorKind kind = report::comparedError(summaries);
    const std::string question = "least " + std::string(report::label(kind)) + formatted(" under %g ms: ", budgetMs);
    const auto choice = report::confirmedUnderBudget(summaries, kind, budgetMs, walkAgain);
    if (!choice) return question + "no run keeps it twice\n";
    return question + summaries[choice->run].options +
           formatted(" (%.4g ms, %.4g ms when walked again)\n", summaries[choice->run].p50Ms, choice->p50MsAgain);
}

std::string underBoundText(double maxAliasing, std::span<const report::RunSummary> summaries) {
    const std::string question = "fastest with a promise of at most " + settings::shortest(maxAliasing) + ": ";
    const auto choice = report::cheapestUnderError(summaries, report::ErrorKind::AliasingBound, maxAliasing);
    if (!choice) return question + "no run does\n";
    return question + summaries[*choice].options + formatted(" (%.4g ms)\n", summaries[*choice].p50Ms);
}

std::string changesText(
    const Baseline& baseline, std::span<const report::RunSummary> summaries, double failAbovePercent) {
    std::string lines;
    for (const report::RunSummary& now : summaries) {
        const auto before = baseline.p50Ms.find(now.name);
        if (before == baseline.p50Ms.end()) continue;
        const double change = before->second > 0 ? 100 * (now.p50Ms / before->second - 1) : 0;
        lines += padded(now.name) + formatted(" %9.2f ms, %9.2f before: %+.1f%%", now.p50Ms, before->second, change);
        if (now.noise) lines += formatted(", noise %.1f%%", 100 * *now.noise);
        lines += isSlower(before->second, now.p50Ms, failAbovePercent) ? ", FAILS: more than " : ", passes: at most ";
        lines += formatted("%+g%%\n", failAbovePercent);
    }
    return lines;
}

} // namespace gnomon::bench
