#include "bench/bench_text.h"

#include "core/formatted.h"
#include "report/sentences.h"
#include "settings/codec.h"

#include <algorithm>
#include <array>
#include <cstdio>
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
    return report::recommendationText(summaries, {maxWrongShare, std::nullopt}) + "\n";
}

BudgetChoice underBudget(
    const report::Request& request,
    std::span<const RunSummary> summaries,
    const std::function<RunSummary(std::size_t)>& walkAgain) {
    const auto choice = report::recommendConfirmed(summaries, request, walkAgain);
    if (!choice) {
        const auto fastest =
            std::min_element(summaries.begin(), summaries.end(), [](const RunSummary& a, const RunSummary& b) {
                return a.p50Ms < b.p50Ms;
            });
        return {
            "budget: " + report::reasonForNone(summaries, request) +
                formatted(" The fastest run takes %.4g ms.\n", fastest->p50Ms),
            false};
    }
    const std::string& options = summaries[choice->run].options;
    return {
        "budget: " + (options.empty() ? "the default options" : options) + ". " +
            report::reasonFor(choice->run, summaries, request) +
            formatted(" In a second measurement it took %.4g ms.\n", choice->p50MsAgain),
        true};
}

std::string underBoundText(double maxAliasing, std::span<const RunSummary> summaries) {
    const std::string question = "fastest with an aliasing bound of at most " + settings::shortest(maxAliasing) + ": ";
    std::vector<RunSummary> runs(summaries.begin(), summaries.end());
    for (RunSummary& run : runs)
        if (report::isExact(run)) run.errors[ErrorKind::AliasingBound] = 0;
    const auto choice = report::cheapestUnderError(runs, ErrorKind::AliasingBound, maxAliasing);
    if (!choice) return question + "no run\n";
    return question + summaries[*choice].options + formatted(" (%.4g ms)\n", summaries[*choice].p50Ms);
}

} // namespace gnomon::bench
