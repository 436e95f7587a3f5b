// The comparison of two sets of frame times: log ratios at equal positions of a path, with a bootstrap interval.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::bench {

/// Times in milliseconds: one list per repetition, with one time per position of the path.
using Times = std::vector<std::vector<double>>;

/// The compared quantity.
enum class TimeStatistic : std::uint8_t {
    Median,    // log ratio of frame times at the same position: the middle half of all positions, averaged
    P99,       // log ratio of the 99th percentiles of all frame times
    SlowShare, // difference of the shares of frames above twice the median of their repetition
};

/// The relation between the repetitions of both sides.
enum class Pairing : std::uint8_t {
    None,       // The sides were measured one after the other.
    Repetitions // Repetition i of both sides was measured at the same time.
};

/// The options of the bootstrap.
struct BootstrapOptions {
    int resamples = 1000;
    std::uint64_t seed = 1;
};

/// A difference between two sides with its 99% interval. The unit is the natural logarithm of a ratio, or a share for
/// SlowShare.
struct Difference {
    double estimate = 0;
    double low = 0;
    double high = 0;
};

/// The assumed standard deviation between repetitions, as a log ratio, of a side with only one repetition.
inline constexpr double kAssumedDeviation = 0.1;

/// Returns the difference `after` minus `before`. The interval comes from a seeded bootstrap, which resamples
/// repetitions first and then blocks of neighbouring frames, because neighbouring frames correlate (Künsch 1989). For
/// P99 and SlowShare it resamples only repetitions if there are several: a slow frame that is at the same position in
/// each repetition is not due to chance. The interval is widened by Student's t for the number of repetitions, and by
/// kAssumedDeviation for a side with one repetition. Repetitions of different length are reduced to their medians.
/// Returns nullopt if a side has no repetition, an empty repetition, or a time that is not positive and finite.
std::optional<Difference> difference(
    const Times& before,
    const Times& after,
    TimeStatistic statistic,
    Pairing pairing = Pairing::None,
    const BootstrapOptions& options = {});

/// Returns the difference without an interval, by the definition of `statistic`.
double plainDifference(const Times& before, const Times& after, TimeStatistic statistic);

/// Returns the mean of the middle half of `values`: a quarter of them is removed at each end, rounded down. `values`
/// must not be empty.
double midmean(std::vector<double> values);

/// Returns the length of the blocks of a path with `frames` frames: the square root, rounded up.
std::size_t blockLength(std::size_t frames);

/// The decision about a difference and its limit.
enum class Decision : std::uint8_t { Pass, Fail, Undecided };

/// Returns Fail if the whole interval lies above `limit`, Pass if it lies at or below `limit`, otherwise Undecided.
Decision decide(const Difference& difference, double limit);

/// Returns the smallest difference that would fail with an interval of the same width: `limit` plus the distance from
/// the lower end of the interval to the estimate.
double detectable(const Difference& difference, double limit);

} // namespace gnomon::bench
