#include "report/sentences.h"

#include "report/accuracy_cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

namespace gnomon::report {

namespace {

/// Relative difference below which two errors count as equal.
constexpr double kTelling = 0.1;

std::string text(const char* format, double value) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, value);
    return buffer.data();
}

/// A setting with its name in a sentence.
struct Named {
    const RunSummary* run = nullptr;
    std::string name; // for example "four maps"
    bool isOne = false;
};

std::string countInWords(int count) {
    constexpr std::array kWords = {"no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"};
    const auto index = static_cast<std::size_t>(count);
    return index < kWords.size() ? kWords[index] : std::to_string(count);
}

Named namedMaps(const RunSummary& run) {
    const bool isOne = run.shadowMaps == 1;
    return {&run, countInWords(run.shadowMaps) + (isOne ? " map" : " maps"), isOne};
}

std::string atStart(const std::string& words) {
    std::string result = words;
    if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') result[0] = static_cast<char>(words[0] - 'a' + 'A');
    return result;
}

/// Returns for example "0.3% wrong pixels instead of 1.2%".
std::string errorsInWords(ErrorKind kind, double a, const std::string& joint, double b) {
    const auto share = [&](const char* what) {
        return (a > 0 ? text("%.2g%% ", 100 * a) : "no ") + what + joint + (b > 0 ? text("%.2g%%", 100 * b) : "none");
    };
    switch (kind) {
    case ErrorKind::WrongPixels:
        return share("wrong pixels");
    case ErrorKind::WrongShadow:
        return share("wrong shadow pixels");
    case ErrorKind::ShadowEdge:
        return text("shadow edges %.2g pixels off", a) + joint + text("%.2g", b);
    case ErrorKind::AliasingBound:
    case ErrorKind::MeasuredAliasing:
        return text("texels up to %.2g pixels wide", a) + joint + text("%.2g", b);
    case ErrorKind::ImageDifference:
        return share("image difference");
    }
    return {};
}

/// Returns the name of an error in a sentence.
std::string errorName(ErrorKind kind) {
    switch (kind) {
    case ErrorKind::WrongPixels:
        return "wrong pixels";
    case ErrorKind::WrongShadow:
        return "wrong shadow pixels";
    case ErrorKind::ShadowEdge:
        return "distance of shadow edges";
    case ErrorKind::AliasingBound:
    case ErrorKind::MeasuredAliasing:
        return "width of texels";
    case ErrorKind::ImageDifference:
        return "image difference";
    }
    return {};
}

int sign(TimeOrder order) {
    return order == TimeOrder::Less ? -1 : order == TimeOrder::More ? 1 : 0;
}

/// Compares two errors: -1 if `a` is less than `b` by more than a tenth of the larger, 1 for the opposite, otherwise 0.
int compareErrors(double a, double b) {
    if (a < (1 - kTelling) * b) return -1;
    return b < (1 - kTelling) * a ? 1 : 0;
}

std::string percentOfNoise(const RunSummary& a, const RunSummary& b) {
    return text("%.2g%%", 100 * std::max(a.noise.value_or(kUnknownNoise), b.noise.value_or(kUnknownNoise)));
}

/// Returns for example "1.21 to 1.48 times the frame time": the range of ratios within the noise, rounded outwards.
std::string timeInWords(const RunSummary& a, const RunSummary& b) {
    if (compareTimes(a, b) == TimeOrder::Alike)
        return "a frame time that noise (" + percentOfNoise(a, b) + ") does not tell apart";
    const auto rounded = [](double ratio, auto round) {
        const double step = ratio < 10 ? 0.01 : std::pow(10, std::floor(std::log10(ratio)) - 1);
        return text("%.3g", round(ratio / step) * step);
    };
    const auto [minA, maxA] = timeRange(a);
    const auto [minB, maxB] = timeRange(b); // the ranges are disjoint, so neither upper end is 0
    const std::string low = rounded(minA / maxB, [](double x) { return std::floor(x); });
    if (!(minB > 0)) return "at least " + low + " times the frame time";
    const std::string high = rounded(maxA / minB, [](double x) { return std::ceil(x); });
    return (low == high ? low : low + " to " + high) + " times the frame time";
}

/// Returns the verdict of `a` against `b`. `costs` is 1 if `a` takes more time than `b`, -1 for less and 0 for equal.
/// `errs` says the same about errors.
std::string verdictInWords(const Named& a, const Named& b, int costs, int errs) {
    if (costs == 0 && errs == 0)
        return (a.isOne ? " does" : " do") + std::string(" here what ") + b.name + (b.isOne ? " does" : " do");
    if (costs * errs < 0)
        return (a.isOne ? " trades " : " trade ") + std::string(errs < 0 ? "time for accuracy" : "accuracy for time") +
               " here beside " + b.name;
    return (a.isOne ? " is " : " are ") + std::string(costs + errs < 0 ? "better" : "worse") + " here than " + b.name;
}

/// Returns a sentence that compares two settings: "Four maps are better here than one map: 0.3% wrong pixels instead of
/// 1.2%...".
std::string comparison(const Named& a, const Named& b, ErrorKind kind) {
    const auto errorA = knownError(*a.run, kind);
    const auto errorB = knownError(*b.run, kind);
    const std::string time = timeInWords(*a.run, *b.run);
    const std::string subject = atStart(a.name);
    const int costs = sign(compareTimes(*a.run, *b.run));
    if (!errorA || !errorB)
        return subject + (a.isOne ? " takes " : " take ") + time + (costs == 0 ? " from that of " : " of ") + b.name +
               ".";
    const int errs = compareErrors(*errorA, *errorB);
    const std::string verdict = verdictInWords(a, b, costs, errs);
    return subject + verdict + ": " + errorsInWords(kind, *errorA, errs == 0 ? " beside " : " instead of ", *errorB) +
           ", and " + time + ".";
}

/// Returns the fastest run per number of maps, fewest maps first. All other settings must equal those of the first run.
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

/// Returns the first run of `sweep` after which no larger number of maps lowers the error by a tenth.
const RunSummary* sufficientMaps(const std::vector<const RunSummary*>& sweep, ErrorKind kind) {
    for (std::size_t i = 0; i + 1 < sweep.size(); ++i) {
        const double here = knownError(*sweep[i], kind).value_or(0);
        const bool improves =
            std::any_of(sweep.begin() + static_cast<std::ptrdiff_t>(i) + 1, sweep.end(), [&](auto* run) {
                return knownError(*run, kind).value_or(here) < (1 - kTelling) * here;
            });
        if (!improves) return sweep[i];
    }
    return nullptr;
}

/// Returns the run of exact shadows with the default sample grid, or null.
const RunSummary* exactRun(std::span<const RunSummary> runs) {
    const auto exact = std::find_if(runs.begin(), runs.end(), [](const RunSummary& run) {
        const auto cells = run.settings.find("cells");
        return cells != run.settings.end() && cells->second == "map+w";
    });
    return exact == runs.end() ? nullptr : &*exact;
}

} // namespace

std::vector<std::string> sentences(std::span<const RunSummary> runs) {
    std::vector<std::string> result;
    if (runs.empty()) return result;
    const auto sweep = sweepOverMaps(runs);
    if (sweep.size() < 2) return result;
    const RunSummary& one = *sweep.front();
    const auto four = std::find_if(sweep.begin() + 1, sweep.end(), [](auto* run) { return run->shadowMaps >= 4; });
    const RunSummary& more = four == sweep.end() ? *sweep.back() : **four;
    const RunSummary* exact = exactRun(runs);
    if (exact != nullptr && knownError(*exact, ErrorKind::WrongPixels) && knownError(more, ErrorKind::WrongPixels))
        result.push_back(comparison({exact, "exact shadows", false}, namedMaps(more), ErrorKind::WrongPixels));
    const ErrorKind kind = shadowError(runs);
    result.push_back(comparison(namedMaps(more), {&one, countInWords(one.shadowMaps), one.shadowMaps == 1}, kind));
    const RunSummary* sufficient = sufficientMaps(sweep, kind);
    if (sufficient != nullptr && knownError(*sufficient, kind).value_or(0) > 0) {
        const std::string name = namedMaps(*sufficient).name;
        result.push_back(
            atStart(name) + (sufficient->shadowMaps == 1 ? " is" : " are") +
            " enough here: no larger number that was tried lowers the " + errorName(kind) + " by a tenth.");
    }
    return result;
}

} // namespace gnomon::report
