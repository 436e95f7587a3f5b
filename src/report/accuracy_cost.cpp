#include "report/accuracy_cost.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gnomon::report {

namespace {

/// Returns true if there are runs with maps and all of them have the error. Other runs never have errors of maps.
bool allMapsKnow(std::span<const RunSummary> runs, ErrorKind kind) {
    const auto lacks = [&](const auto& run) { return run.shadowMaps > 0 && !knownError(run, kind); };
    return std::none_of(runs.begin(), runs.end(), lacks) &&
           std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.shadowMaps > 0; });
}

/// Returns the ranks of `values`, starting at 0. Equal values share their mean rank.
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

} // namespace

std::optional<double> knownError(const RunSummary& run, ErrorKind kind) {
    const auto found = run.errors.find(kind);
    if (found == run.errors.end() || !std::isfinite(found->second)) return std::nullopt;
    return found->second;
}

std::string_view key(ErrorKind kind) {
    switch (kind) {
    case ErrorKind::WrongPixels:
        return "wrong_pixels_all";
    case ErrorKind::AliasingBound:
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
        return "wrong pixels (share of all pixels)";
    case ErrorKind::AliasingBound:
        return "aliasing bound (texel widths per pixel width)";
    case ErrorKind::MeasuredAliasing:
        return "measured aliasing (texel widths per pixel width)";
    case ErrorKind::WrongShadow:
        return "wrong or missed shadow pixels (share of the lit side)";
    case ErrorKind::ShadowEdge:
        return "shadow edge distance (pixels, 99th percentile)";
    case ErrorKind::ImageDifference:
        return "image difference (mean, share of full scale)";
    }
    return {};
}

ErrorKind leadingError(std::span<const RunSummary> runs) {
    const auto isKnown = [](const RunSummary& run) { return knownError(run, ErrorKind::WrongPixels).has_value(); };
    return std::any_of(runs.begin(), runs.end(), isKnown) ? ErrorKind::WrongPixels : ErrorKind::AliasingBound;
}

ErrorKind shadowError(std::span<const RunSummary> runs) {
    for (const ErrorKind kind : {ErrorKind::WrongShadow, ErrorKind::ShadowEdge})
        if (allMapsKnow(runs, kind)) return kind;
    return ErrorKind::AliasingBound;
}

bool dominates(const RunSummary& a, const RunSummary& b, ErrorKind kind) {
    const auto errorA = knownError(a, kind);
    const auto errorB = knownError(b, kind);
    if (!errorA || !errorB) return false;
    const bool nowhereWorse = a.p50Ms <= b.p50Ms && *errorA <= *errorB;
    return nowhereWorse && (a.p50Ms < b.p50Ms || *errorA < *errorB);
}

TimeOrder compareTimes(const RunSummary& a, const RunSummary& b) {
    const TimeRange ofA = timeRange(a);
    const TimeRange ofB = timeRange(b);
    if (ofA.high < ofB.low) return TimeOrder::Less;
    return ofB.high < ofA.low ? TimeOrder::More : TimeOrder::Alike;
}

TimeRange timeRange(const RunSummary& run) {
    const double noise = run.noise.value_or(kUnknownNoise);
    return {run.p50Ms * std::max(0.0, 1 - noise), run.p50Ms * (1 + noise)};
}

std::vector<std::size_t> paretoFront(std::span<const RunSummary> runs, ErrorKind kind) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (knownError(runs[i], kind)) order.push_back(i);
    const auto rank = [&](std::size_t i) { return std::pair(*knownError(runs[i], kind), runs[i].p50Ms); };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return rank(a) < rank(b); });
    std::vector<std::size_t> front; // most accurate run first
    for (const std::size_t i : order)
        if (front.empty() || compareTimes(runs[i], runs[front.back()]) == TimeOrder::Less) front.push_back(i);
    std::reverse(front.begin(), front.end());
    return front;
}

double timeToExpectMs(const RunSummary& run) {
    return run.p50Ms * (1 + run.noise.value_or(0));
}

std::optional<std::size_t> cheapestUnderError(std::span<const RunSummary> runs, ErrorKind kind, double bound) {
    std::optional<std::size_t> best;
    const auto rank = [&](std::size_t run) { return std::pair(runs[run].p50Ms, *knownError(runs[run], kind)); };
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto error = knownError(runs[i], kind);
        if (error && *error <= bound && (!best || rank(i) < rank(*best))) best = i;
    }
    return best;
}

Correlation correlation(std::span<const RunSummary> runs, ErrorKind a, ErrorKind b) {
    std::vector<std::size_t> known;
    std::vector<double> valuesA;
    std::vector<double> valuesB;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto errorA = knownError(runs[i], a);
        const auto errorB = knownError(runs[i], b);
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
            result.outliers.push_back(known[i]);
    return result;
}

} // namespace gnomon::report
