#include "report/sentences.h"

#include "report/accuracy_cost.h"
#include "report/cited.h"
#include "report/recommendation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace gnomon::report {

namespace {

/// Relative difference below which two errors count as equal.
constexpr double kTelling = 0.1;

/// A setting with its name in a sentence.
struct Named {
    const RunSummary* run = nullptr;
    std::string name; // for example "four maps"
    bool isOne = false;
};

Named namedMaps(const RunSummary& run) {
    constexpr std::array kWords = {"no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"};
    const auto count = static_cast<std::size_t>(run.shadowMaps);
    const bool isOne = count == 1;
    const std::string number = count < kWords.size() ? kWords[count] : std::to_string(count);
    return {&run, number + (isOne ? " map" : " maps"), isOne};
}

std::string atStart(std::string words) {
    if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') words[0] = static_cast<char>(words[0] - 'a' + 'A');
    return words;
}

/// Returns -1 if the cited value of `a` is smaller than that of `b` by more than the fraction `within` of the larger, 1
/// for the opposite, otherwise 0.
int compareCited(double a, double b, double within) {
    if (citedValue(a) < (1 - within) * citedValue(b)) return -1;
    return citedValue(b) < (1 - within) * citedValue(a) ? 1 : 0;
}

/// The noise of a comparison in percent, rounded up to a tenth: the larger noise of the two runs.
double noisePercent(const RunSummary& a, const RunSummary& b) {
    return std::ceil(1000 * std::max(a.noise.value_or(kUnknownNoise), b.noise.value_or(kUnknownNoise))) / 10;
}

/// Compares two median times by their cited values and noise: -1 if `a` takes less time even if it is slower by the
/// noise and `b` is faster by the noise, 1 for the opposite, otherwise 0.
int compareCitedTimes(const RunSummary& a, const RunSummary& b) {
    const double noise = noisePercent(a, b) / 100;
    const double msA = citedValue(a.p50Ms);
    const double msB = citedValue(b.p50Ms);
    if (msA * (1 + noise) < msB * (1 - noise)) return -1;
    return msB * (1 + noise) < msA * (1 - noise) ? 1 : 0;
}

/// Returns for example "30.7 ms instead of 37 ms per frame (noise 5%)".
std::string timesInWords(const RunSummary& a, const RunSummary& b) {
    const std::string joint = compareCitedTimes(a, b) == 0 ? " and " : " instead of ";
    const bool isAssumed = !a.noise || !b.noise;
    return cited(a.p50Ms) + " ms" + joint + cited(b.p50Ms) + " ms per frame (" + (isAssumed ? "assumed " : "") +
           "noise " + cited(noisePercent(a, b)) + "%)";
}

/// Returns the verdict of `a` against `b`, which follows "are" or "is". `costs` is 1 if `a` takes more time than `b`,
/// -1 for less and 0 for about equal. `errs` says the same about wrong pixels.
std::string verdictInWords(const std::string& b, int costs, int errs) {
    const std::string speed = costs < 0 ? "faster" : "slower";
    const std::string accuracy = errs < 0 ? "more accurate" : "less accurate";
    if (costs == 0 && errs == 0) return "about as fast and as accurate as " + b;
    if (costs == 0) return accuracy + " than " + b + " at about the same frame time";
    if (errs == 0) return speed + " than " + b + " at about the same accuracy";
    return speed + (costs == errs ? " and " : " but ") + accuracy + " than " + b;
}

/// Returns a sentence that compares two settings: "Exact shadows are faster and more accurate than four maps: 0%
/// instead of 0.25% wrong pixels, and 30.7 ms instead of 37 ms per frame (noise 5%)."
std::string comparison(const Named& a, const Named& b) {
    const std::string subject = atStart(a.name) + (a.isOne ? " is " : " are ");
    const int costs = compareCitedTimes(*a.run, *b.run);
    const std::string times = timesInWords(*a.run, *b.run);
    const auto errorA = wrongPixels(*a.run);
    const auto errorB = wrongPixels(*b.run);
    if (!errorA || !errorB)
        return subject +
               (costs == 0  ? "about as fast as "
                : costs < 0 ? "faster than "
                            : "slower than ") +
               b.name + ": " + times + ".";
    const int errs = compareCited(*errorA, *errorB, kTelling);
    return subject + verdictInWords(b.name, costs, errs) + ": " + citedPercent(*errorA) +
           (errs == 0 ? " and " : " instead of ") + citedPercent(*errorB) + " wrong pixels, and " + times + ".";
}

std::map<std::string, std::string> otherSettings(const RunSummary& run) {
    auto settings = run.settings;
    for (const char* key : {"shadow_maps", "z_partitions"})
        settings.erase(key);
    return settings;
}

/// Returns the fastest run per number of maps, fewest maps first. All other settings must equal those of the first run
/// with maps.
std::vector<const RunSummary*> sweepOverMaps(std::span<const RunSummary> runs) {
    const RunSummary* first = nullptr;
    std::map<int, const RunSummary*> sweep;
    for (const RunSummary& run : runs) {
        if (run.shadowMaps < 1) continue;
        if (first == nullptr) first = &run;
        if (otherSettings(run) != otherSettings(*first)) continue;
        const auto [place, isNew] = sweep.emplace(run.shadowMaps, &run);
        if (!isNew && run.p50Ms < place->second->p50Ms) place->second = &run;
    }
    std::vector<const RunSummary*> result;
    result.reserve(sweep.size());
    for (const auto& [maps, run] : sweep)
        result.push_back(run);
    return result;
}

/// Returns the first run of `sweep` after which no larger number of maps lowers the wrong pixels by a tenth. Returns
/// null if it is the last one, or if a run was not compared with a ground truth.
const RunSummary* sufficientMaps(const std::vector<const RunSummary*>& sweep) {
    if (!std::all_of(sweep.begin(), sweep.end(), [](auto* run) { return wrongPixels(*run).has_value(); }))
        return nullptr;
    for (auto here = sweep.begin(); here + 1 < sweep.end(); ++here)
        if (std::none_of(here + 1, sweep.end(), [&](auto* run) {
                return compareCited(*wrongPixels(*run), *wrongPixels(**here), kTelling) < 0;
            }))
            return *here;
    return nullptr;
}

/// Returns the first run with exact shadows that has the level of detail of `maps`, or null.
const RunSummary* exactRun(std::span<const RunSummary> runs, const RunSummary& maps) {
    const auto detail = [](const RunSummary& run) {
        const auto found = run.settings.find("error_pixels");
        return found == run.settings.end() ? std::string() : found->second;
    };
    const auto exact = std::find_if(
        runs.begin(), runs.end(), [&](const RunSummary& run) { return isExact(run) && detail(run) == detail(maps); });
    return exact == runs.end() ? nullptr : &*exact;
}

/// Returns true if the recommended run is in `sweep` and has more maps than `run`.
bool isMoreRecommended(
    std::span<const RunSummary> runs, const std::vector<const RunSummary*>& sweep, const RunSummary& run) {
    const auto choice = recommend(runs);
    return choice && runs[*choice].shadowMaps > run.shadowMaps &&
           otherSettings(runs[*choice]) == otherSettings(*sweep.front());
}

} // namespace

std::vector<std::string> sentences(std::span<const RunSummary> runs) {
    std::vector<std::string> result;
    const auto sweep = sweepOverMaps(runs);
    if (sweep.empty()) return result;
    const auto four = std::find_if(sweep.begin(), sweep.end(), [](auto* run) { return run->shadowMaps >= 4; });
    const RunSummary& more = four == sweep.end() ? *sweep.back() : **four;
    if (const RunSummary* exact = exactRun(runs, more))
        result.push_back(comparison({exact, "exact shadows", false}, namedMaps(more)));
    if (sweep.size() < 2) return result;
    const RunSummary& fewest = *sweep.front();
    result.push_back(comparison(namedMaps(&more == &fewest ? *sweep.back() : more), namedMaps(fewest)));
    const RunSummary* sufficient = sufficientMaps(sweep);
    if (sufficient != nullptr && *wrongPixels(*sufficient) > 0 && !isMoreRecommended(runs, sweep, *sufficient))
        result.push_back(
            atStart(namedMaps(*sufficient).name) + (sufficient->shadowMaps == 1 ? " suffices" : " suffice") +
            " here (" + citedPercent(*wrongPixels(*sufficient)) +
            " wrong pixels): no larger number of maps in this bench lowers this share by more than a tenth.");
    return result;
}

} // namespace gnomon::report
