#include "report/accuracy_cost.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace gnomon::report {

namespace {

std::optional<double> errorOf(const RunSummary& run, ErrorKind kind) {
    const auto found = run.errors.find(kind);
    if (found == run.errors.end() || !std::isfinite(found->second)) return std::nullopt;
    return found->second;
}

bool allKnow(std::span<const RunSummary> runs, ErrorKind kind) {
    return std::all_of(runs.begin(), runs.end(), [&](const auto& run) { return errorOf(run, kind).has_value(); });
}

/// The same for the runs with maps, if there are any: the others have no such errors.
bool allMapsKnow(std::span<const RunSummary> runs, ErrorKind kind) {
    const auto lacks = [&](const auto& run) { return run.shadowMaps > 0 && !errorOf(run, kind); };
    return std::none_of(runs.begin(), runs.end(), lacks) &&
           std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.shadowMaps > 0; });
}

/// Ranks from 0; equal values share the mean of their ranks.
std::vector<double> ranks(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
    std::vector<double> result(values.size());
    for (std::size_t begin = 0; begin < order.size();) {
        std::size_t end = begin;
        while (end < order.size() && values[order[end]] == values[order[begin]])
            ++end;
        const double mean = (static_cast<double>(begin) + static_cast<double>(end) - 1) / 2;
        for (std::size_t i = begin; i < end; ++i)
            result[order[i]] = mean;
        begin = end;
    }
    return result;
}

double pearson(const std::vector<double>& a, const std::vector<double>& b) {
    const auto n = static_cast<double>(a.size());
    const double meanA = std::accumulate(a.begin(), a.end(), 0.0) / n;
    const double meanB = std::accumulate(b.begin(), b.end(), 0.0) / n;
    double ab = 0;
    double aa = 0;
    double bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - meanA) * (b[i] - meanB);
        aa += (a[i] - meanA) * (a[i] - meanA);
        bb += (b[i] - meanB) * (b[i] - meanB);
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

std::string text(const char* format, double value) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, value);
    return buffer.data();
}

std::string mapCount(int maps) {
    return maps == 1 ? "One map" : std::to_string(maps) + " maps";
}

/// The fastest run of each number of maps, fewest maps first, among those that differ from the first run in nothing
/// else.
std::vector<const RunSummary*> sweepOverMaps(std::span<const RunSummary> runs) {
    const auto others = [](const RunSummary& run) {
        auto settings = run.settings;
        for (const char* key : {"shadow_maps", "z_partitions"})
            settings.erase(key);
        return settings;
    };
    std::map<int, const RunSummary*> sweep;
    for (const RunSummary& run : runs) {
        if (run.shadowMaps < 1 || others(run) != others(runs.front())) continue;
        const auto [place, isNew] = sweep.emplace(run.shadowMaps, &run);
        if (!isNew && run.p50Ms < place->second->p50Ms) place->second = &run;
    }
    std::vector<const RunSummary*> result;
    result.reserve(sweep.size());
    for (const auto& [maps, run] : sweep)
        result.push_back(run);
    return result;
}

/// The first number of maps after which no further map lowers the error by at least a tenth.
std::optional<int> enoughMaps(const std::vector<const RunSummary*>& sweep, ErrorKind kind) {
    for (std::size_t i = 0; i + 1 < sweep.size(); ++i) {
        const double here = errorOf(*sweep[i], kind).value_or(0);
        const bool improves =
            std::any_of(sweep.begin() + static_cast<std::ptrdiff_t>(i) + 1, sweep.end(), [&](auto* run) {
                return errorOf(*run, kind).value_or(here) < 0.9 * here;
            });
        if (!improves) return sweep[i]->shadowMaps;
    }
    return std::nullopt;
}

/// What exact shadows cost and leave beside `maps`, if there is such a run of the usual cells and both know their wrong
/// pixels.
std::optional<std::string> exactSentence(std::span<const RunSummary> runs, const RunSummary& maps) {
    const auto exact = std::find_if(runs.begin(), runs.end(), [](const RunSummary& run) {
        const auto cells = run.settings.find("cells");
        return cells != run.settings.end() && cells->second == "map+w";
    });
    if (exact == runs.end()) return std::nullopt;
    const auto ownWrong = errorOf(*exact, ErrorKind::WrongPixels);
    const auto mapsWrong = errorOf(maps, ErrorKind::WrongPixels);
    if (!ownWrong || !mapsWrong || !(maps.p50Ms > 0)) return std::nullopt;
    return "Exact shadows cost " + text("%.2g", exact->p50Ms / maps.p50Ms) + " times the frame of " +
           (maps.shadowMaps == 1 ? "one map" : std::to_string(maps.shadowMaps) + " maps") + " and leave " +
           (*ownWrong > 0 ? text("%.2g%%", 100 * *ownWrong) + " of all pixels" : "no pixel") + " wrong, where " +
           (maps.shadowMaps == 1 ? "that leaves " : "those leave ") + text("%.2g%%", 100 * *mapsWrong) + ".";
}

} // namespace

std::string_view key(ErrorKind kind) {
    switch (kind) {
    case ErrorKind::WrongPixels:
        return "wrong_pixels_all";
    case ErrorKind::PromisedAliasing:
        return "promised_aliasing";
    case ErrorKind::MeasuredAliasing:
        return "measured_aliasing";
    case ErrorKind::WrongShadow:
        return "wrong_or_missed_fraction";
    case ErrorKind::ShadowEdge:
        return "shadow_edge_p99_px";
    case ErrorKind::ImageDifference:
        return "image_difference";
    }
    return {};
}

std::string_view label(ErrorKind kind) {
    switch (kind) {
    case ErrorKind::WrongPixels:
        return "wrong pixels (fraction of all, against integers)";
    case ErrorKind::PromisedAliasing:
        return "promised aliasing (texel widths per pixel width)";
    case ErrorKind::MeasuredAliasing:
        return "measured aliasing (texel widths per pixel width)";
    case ErrorKind::WrongShadow:
        return "wrong or missed shadow pixels (fraction of the lit side)";
    case ErrorKind::ShadowEdge:
        return "shadow edge distance (pixels, 99th percentile)";
    case ErrorKind::ImageDifference:
        return "image difference (mean, fraction of full scale)";
    }
    return {};
}

ErrorKind comparedError(std::span<const RunSummary> runs) {
    return allKnow(runs, ErrorKind::ImageDifference) ? ErrorKind::ImageDifference : shadowError(runs);
}

ErrorKind leadingError(std::span<const RunSummary> runs) {
    return allKnow(runs, ErrorKind::WrongPixels) ? ErrorKind::WrongPixels : comparedError(runs);
}

ErrorKind shadowError(std::span<const RunSummary> runs) {
    for (const ErrorKind kind : {ErrorKind::WrongShadow, ErrorKind::ShadowEdge})
        if (allMapsKnow(runs, kind)) return kind;
    return ErrorKind::PromisedAliasing;
}

bool dominates(const RunSummary& a, const RunSummary& b, ErrorKind kind) {
    const auto errorA = errorOf(a, kind);
    const auto errorB = errorOf(b, kind);
    if (!errorA || !errorB) return false;
    const bool nowhereWorse = a.p50Ms <= b.p50Ms && *errorA <= *errorB;
    return nowhereWorse && (a.p50Ms < b.p50Ms || *errorA < *errorB);
}

std::vector<std::size_t> paretoFront(std::span<const RunSummary> runs, ErrorKind kind) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (errorOf(runs[i], kind)) order.push_back(i);
    const auto cost = [&](std::size_t i) { return std::pair(runs[i].p50Ms, *errorOf(runs[i], kind)); };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return cost(a) < cost(b); });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || cost(i).second < cost(front.back()).second || cost(i) == cost(front.back()))
            front.push_back(i);
    return front;
}

double timeToExpectMs(const RunSummary& run) {
    return run.p50Ms * (1 + run.noise.value_or(0));
}

std::optional<std::size_t> bestUnderBudget(std::span<const RunSummary> runs, ErrorKind kind, double budgetMs) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto error = errorOf(runs[i], kind);
        if (!error || timeToExpectMs(runs[i]) > budgetMs) continue;
        const auto rank = [&](std::size_t run) { return std::pair(*errorOf(runs[run], kind), runs[run].p50Ms); };
        if (!best || rank(i) < rank(*best)) best = i;
    }
    return best;
}

std::optional<ConfirmedRun> confirmedUnderBudget(
    std::span<const RunSummary> runs,
    ErrorKind kind,
    double budgetMs,
    const std::function<RunSummary(std::size_t run)>& walkAgain) {
    std::vector<RunSummary> candidates(runs.begin(), runs.end());
    while (const auto best = bestUnderBudget(candidates, kind, budgetMs)) {
        const RunSummary again = walkAgain(*best);
        if (timeToExpectMs(again) <= budgetMs) return ConfirmedRun{*best, again.p50Ms};
        candidates[*best].errors.erase(kind);
    }
    return std::nullopt;
}

std::optional<std::size_t> cheapestUnderError(std::span<const RunSummary> runs, ErrorKind kind, double bound) {
    for (const std::size_t i : paretoFront(runs, kind))
        if (*errorOf(runs[i], kind) <= bound) return i;
    return std::nullopt;
}

Correlation correlation(std::span<const RunSummary> runs, ErrorKind a, ErrorKind b) {
    std::vector<std::size_t> known;
    std::vector<double> valuesA;
    std::vector<double> valuesB;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto errorA = errorOf(runs[i], a);
        const auto errorB = errorOf(runs[i], b);
        if (!errorA || !errorB) continue;
        known.push_back(i);
        valuesA.push_back(*errorA);
        valuesB.push_back(*errorB);
    }
    Correlation result;
    result.runs = known.size();
    if (known.size() < 3) return result;
    const auto ranksA = ranks(valuesA);
    const auto ranksB = ranks(valuesB);
    result.rank = pearson(ranksA, ranksB);
    for (std::size_t i = 0; i < known.size(); ++i)
        if (std::abs(ranksA[i] - ranksB[i]) > static_cast<double>(known.size()) / 3)
            result.disobedient.push_back(known[i]);
    return result;
}

std::vector<std::string> sentences(std::span<const RunSummary> runs) {
    std::vector<std::string> result;
    if (runs.empty()) return result;
    const auto sweep = sweepOverMaps(runs);
    if (sweep.size() < 2) return result;
    const RunSummary& one = *sweep.front();
    const auto four = std::find_if(sweep.begin() + 1, sweep.end(), [](auto* run) { return run->shadowMaps >= 4; });
    const RunSummary& more = four == sweep.end() ? *sweep.back() : **four;
    if (const auto exact = exactSentence(runs, more)) result.push_back(*exact);
    const ErrorKind kind = shadowError(runs);
    const double before = errorOf(one, kind).value_or(0);
    std::string first = mapCount(more.shadowMaps) + " cost " + text("%.2g", more.p50Ms / one.p50Ms) +
                        " times the frame of " + (one.shadowMaps == 1 ? "one" : std::to_string(one.shadowMaps));
    if (before > 0 && errorOf(more, kind)) {
        const std::string what = kind == ErrorKind::WrongShadow  ? "wrong shadow pixels"
                                 : kind == ErrorKind::ShadowEdge ? "shadow-edge distance"
                                                                 : "promised aliasing";
        first += " and leave " + text("%.2g", *errorOf(more, kind) / before) + " of its " + what;
    }
    result.push_back(first + ".");
    if (const auto enough = enoughMaps(sweep, kind); enough && before > 0)
        result.push_back(
            "More than " + (*enough == 1 ? "one map buys" : std::to_string(*enough) + " maps buy") +
            " nothing here (less than a tenth).");
    return result;
}

} // namespace gnomon::report
