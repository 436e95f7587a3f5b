// Paired times against slow twins, and intervals against simulated machines whose true difference is known.
#include "bench/paired_times.h"
#include "core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::bench {
namespace {

double normal(Random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i)
        sum += random.unit();
    return sum;
}

/// A machine: each repetition has its own speed, neighbouring frames correlate, and each frame has noise.
struct Machine {
    double perRepetition = 0.005;
    double perFrame = 0.01;
    double drift = 0.01;
};

Times timesOf(Random& random, const Machine& machine, int repetitions, int frames, double factor) {
    Times times;
    for (int r = 0; r < repetitions; ++r) {
        std::vector<double>& repetition = times.emplace_back();
        const double speed = machine.perRepetition * normal(random);
        double slow = 0;
        for (int frame = 0; frame < frames; ++frame) {
            slow = 0.8 * slow + machine.drift * normal(random);
            const double scene = 10 + 3 * std::sin(0.1 * frame);
            repetition.push_back(factor * scene * std::exp(speed + slow + machine.perFrame * normal(random)));
        }
    }
    return times;
}

/// The middle half by removing the extremes one by one.
double slowMidmean(std::vector<double> values) {
    const std::size_t pairs = values.size() / 4;
    for (std::size_t i = 0; i < pairs; ++i) {
        values.erase(std::min_element(values.begin(), values.end()));
        values.erase(std::max_element(values.begin(), values.end()));
    }
    double sum = 0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

double slowRatio(const Times& before, const Times& after) {
    std::vector<double> ratios;
    for (std::size_t frame = 0; frame < before.front().size(); ++frame) {
        std::vector<double> a;
        std::vector<double> b;
        for (const auto& repetition : before)
            a.push_back(std::log(repetition[frame]));
        for (const auto& repetition : after)
            b.push_back(std::log(repetition[frame]));
        ratios.push_back(slowMidmean(b) - slowMidmean(a));
    }
    return slowMidmean(ratios);
}

double slowShareOf(const Times& times) {
    double slow = 0;
    double all = 0;
    for (const std::vector<double>& repetition : times) {
        std::vector<double> sorted = repetition;
        std::sort(sorted.begin(), sorted.end());
        const std::size_t n = sorted.size();
        const double median = n % 2 == 1 ? sorted[n / 2] : (sorted[n / 2 - 1] + sorted[n / 2]) / 2;
        for (const double time : repetition) {
            slow += time > 2 * median ? 1 : 0;
            all += 1;
        }
    }
    return slow / all;
}

TEST(PairedTimes, HaveTheEstimateOfASlowTwin) {
    Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const int frames = 1 + static_cast<int>(random.below(30));
        const Machine noisy{0.1, 0.4, 0.1};
        const Times before = timesOf(random, noisy, 1 + static_cast<int>(random.below(6)), frames, 1);
        const Times after = timesOf(random, noisy, 1 + static_cast<int>(random.below(6)), frames, 1.1);
        EXPECT_NEAR(plainDifference(before, after, TimeStatistic::Median), slowRatio(before, after), 1e-9);
        if (frames % 2 == 1) { // between two middle frames, the median of logarithms is the geometric mean
            EXPECT_NEAR(
                plainDifference(before, after, TimeStatistic::SlowShare),
                slowShareOf(after) - slowShareOf(before),
                1e-9);
        }
        const auto found = difference(before, after, TimeStatistic::Median);
        ASSERT_TRUE(found.has_value());
        EXPECT_EQ(found->estimate, plainDifference(before, after, TimeStatistic::Median));
        EXPECT_LE(found->low, found->estimate);
        EXPECT_GE(found->high, found->estimate);
    }
}

TEST(PairedTimes, AreTheSameForTheSameSeed) {
    Random random(2);
    const Times before = timesOf(random, {}, 5, 60, 1);
    const Times after = timesOf(random, {}, 5, 60, 1.02);
    for (const TimeStatistic statistic : {TimeStatistic::Median, TimeStatistic::P99, TimeStatistic::SlowShare}) {
        const auto a = difference(before, after, statistic);
        const auto b = difference(before, after, statistic);
        EXPECT_EQ(a->low, b->low);
        EXPECT_EQ(a->high, b->high);
    }
}

// A scale of all times changes nothing, and exchanged sides change the sign of the estimate.
TEST(PairedTimes, DependOnRatiosOnly) {
    Random random(3);
    for (int trial = 0; trial < 20; ++trial) {
        const Times before = timesOf(random, {}, 4, 30, 1);
        const Times after = timesOf(random, {}, 4, 30, 1.05);
        const auto scaled = [](Times times) {
            for (auto& repetition : times)
                for (double& time : repetition)
                    time *= 8;
            return times;
        };
        for (const TimeStatistic statistic : {TimeStatistic::Median, TimeStatistic::P99, TimeStatistic::SlowShare}) {
            const auto plain = difference(before, after, statistic);
            const auto other = difference(scaled(before), scaled(after), statistic);
            EXPECT_NEAR(plain->low, other->low, 1e-9);
            EXPECT_NEAR(plain->high, other->high, 1e-9);
            EXPECT_NEAR(plainDifference(after, before, statistic), -plain->estimate, 1e-9);
        }
    }
}

TEST(PairedTimes, OfASideWithItselfDoNotDiffer) {
    Random random(4);
    const Times times = timesOf(random, {}, 6, 40, 1);
    const auto found = difference(times, times, TimeStatistic::Median, Pairing::Repetitions);
    EXPECT_EQ(found->estimate, 0);
    EXPECT_EQ(found->low, 0);
    EXPECT_EQ(found->high, 0);
    EXPECT_EQ(decide(*found, 0), Decision::Pass);
}

TEST(PairedTimes, NeedPositiveFiniteTimes) {
    const Times good{{1, 2}, {1, 2}};
    for (const Times& bad :
         {Times{},
          Times{{}},
          Times{{1, 0}},
          Times{{-1}},
          Times{{1, std::nan("")}},
          Times{{std::numeric_limits<double>::infinity()}}}) {
        EXPECT_FALSE(difference(good, bad, TimeStatistic::Median).has_value());
        EXPECT_FALSE(difference(bad, good, TimeStatistic::P99).has_value());
    }
    EXPECT_TRUE(difference(good, {{3}}, TimeStatistic::Median).has_value()) << "reduced to medians";
}

// The true difference lies in the interval in about 99% of simulations, also for few repetitions and correlated frames.
TEST(PairedTimes, CoverTheTrueDifference) {
    Random random(5);
    for (const int repetitions : {3, 5, 9})
        for (const Machine& machine : {Machine{0.01, 0.02, 0}, Machine{0.002, 0.01, 0.02}, Machine{0.05, 0.1, 0.05}}) {
            int covered = 0;
            constexpr int kTrials = 100;
            for (int trial = 0; trial < kTrials; ++trial) {
                const Times before = timesOf(random, machine, repetitions, 40, 1);
                const Times after = timesOf(random, machine, repetitions, 40, 1.03);
                const auto found = difference(before, after, TimeStatistic::Median, Pairing::None, {300, 7});
                covered += found->low <= std::log(1.03) && std::log(1.03) <= found->high ? 1 : 0;
            }
            EXPECT_GE(covered, 95) << repetitions << " repetitions, " << machine.perRepetition;
        }
}

// On a quiet machine, 9 pairs find 5% above a limit of 2%, and the detectable change is below 4%. The noise is that of
// two processes in turns on an idle machine with two cores.
TEST(PairedTimes, FindASmallSlowdownOnAQuietMachine) {
    Random random(6);
    const double limit = std::log(1.02);
    int found = 0;
    int falseAlarms = 0;
    int undecided = 0;
    const Machine quiet{0.003, 0.01, 0.005};
    constexpr int kTrials = 40;
    for (int trial = 0; trial < kTrials; ++trial) {
        const Times before = timesOf(random, quiet, 9, 60, 1);
        const auto slower =
            difference(before, timesOf(random, quiet, 9, 60, 1.05), TimeStatistic::Median, Pairing::Repetitions);
        const auto same =
            difference(before, timesOf(random, quiet, 9, 60, 1), TimeStatistic::Median, Pairing::Repetitions);
        found += decide(*slower, limit) == Decision::Fail ? 1 : 0;
        falseAlarms += decide(*same, limit) == Decision::Fail ? 1 : 0;
        undecided += decide(*same, limit) == Decision::Undecided ? 1 : 0;
        EXPECT_LT(std::expm1(detectable(*slower, limit)), 0.04);
    }
    EXPECT_GE(found, kTrials * 8 / 10);
    EXPECT_EQ(falseAlarms, 0);
    EXPECT_LE(undecided, kTrials / 10);
}

TEST(PairedTimes, OfOneRepetitionAreUndecidedUnlessTheChangeIsLarge) {
    Random random(7);
    const Times before = timesOf(random, {}, 1, 60, 1);
    const double limit = std::log(1.1);
    EXPECT_EQ(
        decide(*difference(before, timesOf(random, {}, 1, 60, 1.2), TimeStatistic::Median), limit),
        Decision::Undecided);
    EXPECT_EQ(decide(*difference(before, timesOf(random, {}, 1, 60, 3), TimeStatistic::Median), limit), Decision::Fail);
}

TEST(PairedTimes, FindOneSlowFrameInTwenty) {
    Random random(8);
    const Times before = timesOf(random, {}, 9, 60, 1);
    Times after = timesOf(random, {}, 9, 60, 1);
    for (auto& repetition : after)
        for (std::size_t frame = 3; frame < repetition.size(); frame += 20)
            repetition[frame] *= 4;
    EXPECT_NE(decide(*difference(before, after, TimeStatistic::Median), std::log(1.1)), Decision::Fail);
    EXPECT_EQ(decide(*difference(before, after, TimeStatistic::SlowShare), 0.02), Decision::Fail);
    EXPECT_EQ(decide(*difference(before, after, TimeStatistic::P99), std::log(1.25)), Decision::Fail);
}

TEST(PairedTimes, DecideByTheWholeInterval) {
    Random random(9);
    for (int trial = 0; trial < 1000; ++trial) {
        Difference d;
        d.low = random.uniform(-1, 1);
        d.high = d.low + random.unit();
        d.estimate = random.uniform(d.low, d.high);
        const double limit = random.uniform(-1, 1);
        const Decision expected = d.low > limit     ? Decision::Fail
                                  : d.high <= limit ? Decision::Pass
                                                    : Decision::Undecided;
        EXPECT_EQ(decide(d, limit), expected);
        const double detected = detectable(d, limit);
        const double shift = detected - d.estimate;
        Difference moved{d.estimate + shift + 1e-9, d.low + shift + 1e-9, d.high + shift + 1e-9};
        EXPECT_EQ(decide(moved, limit), Decision::Fail) << "a change of the detectable size";
        moved.low -= 1e-6;
        EXPECT_NE(decide(moved, limit), Decision::Fail) << "a smaller change";
    }
}

} // namespace
} // namespace gnomon::bench
