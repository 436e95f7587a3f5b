#include "bench/paired_times.h"

#include "core/check.h"
#include "core/random.h"
#include "telemetry/benchmark_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>

namespace gnomon::bench {

namespace {

constexpr double kTail = 0.005;           // on each side of a 99% interval
constexpr double kNormalQuantile = 2.576; // of the normal distribution at 1 - kTail

/// Returns the quantile of Student's t distribution at 1 - kTail.
double studentQuantile(std::size_t degrees) {
    constexpr std::array kQuantiles{63.66, 9.925, 5.841, 4.604, 4.032, 3.707, 3.499, 3.355, 3.250, 3.169,
                                    3.106, 3.055, 3.012, 2.977, 2.947, 2.921, 2.898, 2.878, 2.861, 2.845};
    if (degrees <= kQuantiles.size()) return kQuantiles[degrees - 1];
    const auto n = static_cast<double>(degrees); // the next terms of the expansion in 1/n (Abramowitz, Stegun 26.7.5)
    const double z = kNormalQuantile;
    return z + (z * z * z + z) / (4 * n) + (5 * std::pow(z, 5) + 16 * z * z * z + 3 * z) / (96 * n * n);
}

/// Which repetitions of each side and which positions a sample contains. An index can occur several times.
struct Sample {
    std::vector<std::size_t> before;
    std::vector<std::size_t> after;
    std::vector<std::size_t> frames;
};

/// Returns a positive time per position: the mean over the middle half of the sampled repetitions, as a logarithm.
double logTime(const Times& logs, const std::vector<std::size_t>& repetitions, std::size_t frame) {
    std::vector<double> values;
    values.reserve(repetitions.size());
    for (const std::size_t repetition : repetitions)
        values.push_back(logs[repetition][frame]);
    return midmean(std::move(values));
}

double logTail(const Times& logs, const std::vector<std::size_t>& repetitions, const std::vector<std::size_t>& frames) {
    std::vector<double> values;
    values.reserve(repetitions.size() * frames.size());
    for (const std::size_t repetition : repetitions)
        for (const std::size_t frame : frames)
            values.push_back(logs[repetition][frame]);
    return telemetry::quantile(values, 0.99);
}

double slowShare(
    const Times& logs, const std::vector<std::size_t>& repetitions, const std::vector<std::size_t>& frames) {
    std::size_t slow = 0;
    for (const std::size_t repetition : repetitions) {
        const double limit = telemetry::quantile(logs[repetition], 0.5) + std::log(2);
        for (const std::size_t frame : frames)
            slow += logs[repetition][frame] > limit ? 1 : 0;
    }
    return static_cast<double>(slow) / static_cast<double>(repetitions.size() * frames.size());
}

double sampled(const Times& before, const Times& after, TimeStatistic statistic, const Sample& sample) {
    if (statistic == TimeStatistic::P99)
        return logTail(after, sample.after, sample.frames) - logTail(before, sample.before, sample.frames);
    if (statistic == TimeStatistic::SlowShare)
        return slowShare(after, sample.after, sample.frames) - slowShare(before, sample.before, sample.frames);
    std::vector<double> ratios;
    ratios.reserve(sample.frames.size());
    for (const std::size_t frame : sample.frames)
        ratios.push_back(logTime(after, sample.after, frame) - logTime(before, sample.before, frame));
    return midmean(std::move(ratios));
}

std::vector<std::size_t> allOf(std::size_t count) {
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

Sample wholeSample(const Times& before, const Times& after) {
    return {allOf(before.size()), allOf(after.size()), allOf(before.front().size())};
}

std::vector<std::size_t> drawn(Random& random, std::size_t count) {
    std::vector<std::size_t> indices(count);
    for (std::size_t& index : indices)
        index = random.below(count);
    return indices;
}

/// Returns `count` positions in blocks of neighbours. A block that reaches the end continues at the start.
std::vector<std::size_t> drawnBlocks(Random& random, std::size_t count) {
    const std::size_t length = blockLength(count);
    std::vector<std::size_t> frames;
    frames.reserve(count + length);
    while (frames.size() < count) {
        const std::size_t start = random.below(count);
        for (std::size_t i = 0; i < length; ++i)
            frames.push_back((start + i) % count);
    }
    frames.resize(count);
    return frames;
}

bool isSound(const Times& times) {
    return !times.empty() && std::all_of(times.begin(), times.end(), [](const std::vector<double>& repetition) {
        return !repetition.empty() && std::all_of(repetition.begin(), repetition.end(), [](double time) {
            return time > 0 && std::isfinite(time);
        });
    });
}

/// Returns the logarithms of `times`. If `isReduced`, each repetition has only its median.
Times logsOf(const Times& times, bool isReduced) {
    Times logs;
    for (const std::vector<double>& repetition : times) {
        std::vector<double>& log = logs.emplace_back();
        if (isReduced) {
            log.push_back(std::log(telemetry::quantile(repetition, 0.5)));
            continue;
        }
        std::transform(
            repetition.begin(), repetition.end(), std::back_inserter(log), [](double time) { return std::log(time); });
    }
    return logs;
}

bool areAlikeLong(const Times& before, const Times& after) {
    const std::size_t frames = before.front().size();
    const auto isAlike = [&](const std::vector<double>& repetition) { return repetition.size() == frames; };
    return std::all_of(before.begin(), before.end(), isAlike) && std::all_of(after.begin(), after.end(), isAlike);
}

/// What a bootstrap resamples.
struct Resampling {
    bool repetitions = true;
    bool isPaired = false; // draws the same repetitions of both sides
    bool frames = true;    // in blocks
};

/// Returns the values of `statistic` for `options.resamples` random samples.
std::vector<double> bootstrap(
    const Times& before,
    const Times& after,
    TimeStatistic statistic,
    const Resampling& resampling,
    const BootstrapOptions& options) {
    Random random(options.seed);
    Sample sample = wholeSample(before, after);
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(options.resamples));
    for (int i = 0; i < options.resamples; ++i) {
        if (resampling.repetitions) {
            sample.before = drawn(random, before.size());
            sample.after = resampling.isPaired ? sample.before : drawn(random, after.size());
        }
        if (resampling.frames) sample.frames = drawnBlocks(random, before.front().size());
        values.push_back(sampled(before, after, statistic, sample));
    }
    return values;
}

double variance(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    return std::accumulate(values.begin(), values.end(), 0.0, [&](double sum, double value) {
        return sum + (value - mean) * (value - mean) / n;
    });
}

/// Returns the factor that corrects the interval of the median. Both steps of the bootstrap contain the noise of
/// frames: the repetitions differ by it, too. So it is counted twice (Davison, Hinkley 1997, section 3.8), and the
/// variance of the second step alone, `ofFrames`, is subtracted. It is at most half of the expected variance of both.
double onceCounted(double ofBoth, double ofFrames) {
    return ofBoth > 0 ? std::sqrt(std::max(ofBoth - ofFrames, ofBoth / 2) / ofBoth) : 1;
}

/// Returns the factor that widens the bootstrap's interval for few repetitions: the bootstrap of n values
/// underestimates their deviation by sqrt((n - 1) / n), and has the normal distribution's tails.
double widening(std::size_t repetitions) {
    if (repetitions < 2) return 1; // an assumed deviation is added
    const auto n = static_cast<double>(repetitions);
    return std::sqrt(n / (n - 1)) * studentQuantile(repetitions - 1) / kNormalQuantile;
}

} // namespace

double midmean(std::vector<double> values) {
    GNOMON_CHECK(!values.empty());
    std::sort(values.begin(), values.end());
    const std::size_t removed = values.size() / 4;
    const std::span<const double> middle(values.data() + removed, values.size() - 2 * removed);
    return std::accumulate(middle.begin(), middle.end(), 0.0) / static_cast<double>(middle.size());
}

std::size_t blockLength(std::size_t frames) {
    return static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(frames))));
}

double plainDifference(const Times& before, const Times& after, TimeStatistic statistic) {
    const bool isReduced = !areAlikeLong(before, after);
    const Times logsBefore = logsOf(before, isReduced);
    const Times logsAfter = logsOf(after, isReduced);
    return sampled(logsBefore, logsAfter, statistic, wholeSample(logsBefore, logsAfter));
}

std::optional<Difference> difference(
    const Times& before,
    const Times& after,
    TimeStatistic statistic,
    Pairing pairing,
    const BootstrapOptions& options) {
    if (!isSound(before) || !isSound(after)) return std::nullopt;
    const bool isReduced = !areAlikeLong(before, after);
    const Times logsBefore = logsOf(before, isReduced);
    const Times logsAfter = logsOf(after, isReduced);
    const bool isPaired = pairing == Pairing::Repetitions && before.size() == after.size();
    const std::size_t repetitions = std::min(before.size(), after.size());
    const bool isMedian = statistic == TimeStatistic::Median;
    const auto valuesOf = [&](const Resampling& resampling) {
        return bootstrap(logsBefore, logsAfter, statistic, resampling, options);
    };
    const std::vector<double> values = valuesOf({true, isPaired, isMedian || repetitions < 2});
    double factor = widening(repetitions);
    if (isMedian && repetitions > 1)
        factor *= onceCounted(variance(values), variance(valuesOf({false, isPaired, true})));
    Difference result;
    result.estimate = sampled(logsBefore, logsAfter, statistic, wholeSample(logsBefore, logsAfter));
    const int alone = (before.size() < 2 ? 1 : 0) + (after.size() < 2 ? 1 : 0);
    const double assumed =
        statistic == TimeStatistic::SlowShare ? 0 : kNormalQuantile * kAssumedDeviation * std::sqrt(alone);
    const double below = factor * std::max(0.0, result.estimate - telemetry::quantile(values, kTail));
    const double above = factor * std::max(0.0, telemetry::quantile(values, 1 - kTail) - result.estimate);
    result.low = result.estimate - std::hypot(below, assumed);
    result.high = result.estimate + std::hypot(above, assumed);
    return result;
}

Decision decide(const Difference& difference, double limit) {
    if (difference.low > limit) return Decision::Fail;
    return difference.high <= limit ? Decision::Pass : Decision::Undecided;
}

double detectable(const Difference& difference, double limit) {
    return limit + (difference.estimate - difference.low);
}

} // namespace gnomon::bench
