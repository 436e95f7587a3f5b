#include "core/random.h"
#include "report/accuracy_cost.h"
#include "report/run_summary.h"
#include "tests/report/random_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace gnomon::report {
namespace {

constexpr ErrorKind kKind = ErrorKind::WrongShadow;

RunSummary run(double ms, std::optional<double> error, int maps = 1) {
    RunSummary result;
    result.p50Ms = ms;
    result.shadowMaps = maps;
    if (error) result.errors[kKind] = *error;
    result.settings = {{"warp", "auto"}, {"shadow_maps", std::to_string(maps)}};
    return result;
}

std::vector<RunSummary> randomRuns(Random& random) {
    std::vector<RunSummary> runs;
    const auto count = random.below(40);
    for (std::uint64_t i = 0; i < count; ++i) {
        // Few distinct values, so that ties are common.
        const auto ms = static_cast<double>(1 + random.below(8));
        const auto error = static_cast<double>(random.below(8));
        runs.push_back(run(ms, random.below(10) == 0 ? std::nullopt : std::optional(error)));
        if (random.below(2) == 0) runs.back().noise = random.uniform(0, 0.5);
    }
    return runs;
}

// Without noise, brute force over all pairs beside the sorted sweep; of equals one.
TEST(AccuracyCost, TheFrontWithoutNoiseIsWhatNoRunDominates) {
    Random random(11);
    for (int trial = 0; trial < 500; ++trial) {
        auto runs = randomRuns(random);
        for (RunSummary& each : runs)
            each.noise = 0;
        std::set<std::pair<double, double>> expected;
        for (const RunSummary& each : runs) {
            const bool dominated =
                std::any_of(runs.begin(), runs.end(), [&](const auto& other) { return dominates(other, each, kKind); });
            if (each.errors.contains(kKind) && !dominated) expected.emplace(each.p50Ms, each.errors.at(kKind));
        }
        const auto front = paretoFront(runs, kKind);
        EXPECT_EQ(front.size(), expected.size());
        for (const std::size_t i : front)
            EXPECT_TRUE(expected.contains({runs[i].p50Ms, runs[i].errors.at(kKind)}));
    }
}

TEST(AccuracyCost, TheFrontHasNoPointsThatNoiseCannotPartAndLacksNoBargain) {
    Random random(14);
    for (int trial = 0; trial < 500; ++trial) {
        const auto runs = randomRuns(random);
        const auto front = paretoFront(runs, kKind);
        for (std::size_t a = 0; a < front.size(); ++a)
            for (std::size_t b = a + 1; b < front.size(); ++b) {
                EXPECT_EQ(compareTimes(runs[front[a]], runs[front[b]]), TimeOrder::Less);
                EXPECT_EQ(compareTimes(runs[front[b]], runs[front[a]]), TimeOrder::More);
                EXPECT_GE(runs[front[a]].errors.at(kKind), runs[front[b]].errors.at(kKind));
            }
        for (const RunSummary& each : runs) {
            if (!each.errors.contains(kKind)) continue;
            EXPECT_TRUE(std::any_of(front.begin(), front.end(), [&](std::size_t i) {
                return runs[i].errors.at(kKind) <= each.errors.at(kKind) &&
                       compareTimes(runs[i], each) != TimeOrder::More;
            })) << "a run that is more accurate than all of the front, or faster";
        }
    }
}

TEST(AccuracyCost, TimesCompareWhereTheirRangesAreApart) {
    Random random(15);
    for (int trial = 0; trial < 1000; ++trial) {
        RunSummary a = run(random.uniform(1, 10), 0.0);
        RunSummary b = run(random.uniform(1, 10), 0.0);
        if (random.below(3) != 0) a.noise = random.uniform(0, 1.5);
        if (random.below(3) != 0) b.noise = random.uniform(0, 1.5);
        // Every time that one may have beside every time of the other.
        bool canBeLess = false;
        bool canBeMore = false;
        for (int i = -50; i <= 50; ++i)
            for (int j = -50; j <= 50; ++j) {
                const double timeA = std::max(a.p50Ms * (1 + i / 50.0 * a.noise.value_or(kUnknownNoise)), 0.0);
                const double timeB = std::max(b.p50Ms * (1 + j / 50.0 * b.noise.value_or(kUnknownNoise)), 0.0);
                canBeLess |= timeA < timeB;
                canBeMore |= timeA > timeB;
            }
        EXPECT_EQ(
            compareTimes(a, b),
            canBeLess == canBeMore ? TimeOrder::Alike
            : canBeLess            ? TimeOrder::Less
                                   : TimeOrder::More);
    }
}

TEST(AccuracyCost, FastestRunUnderABoundEqualsBruteForce) {
    Random random(12);
    for (int trial = 0; trial < 500; ++trial) {
        const auto runs = randomRuns(random);
        const double limit = random.uniform(0, 9);
        double minTime = std::numeric_limits<double>::infinity();
        for (const auto& candidate : runs) {
            const auto error = candidate.errors.find(kKind);
            if (error == candidate.errors.end()) continue;
            if (error->second <= limit) minTime = std::min(minTime, candidate.p50Ms);
        }
        const auto cheapest = cheapestUnderError(runs, kKind, limit);
        ASSERT_EQ(cheapest.has_value(), std::isfinite(minTime));
        if (cheapest) {
            EXPECT_EQ(runs[*cheapest].p50Ms, minTime);
            EXPECT_LE(runs[*cheapest].errors.at(kKind), limit);
        }
    }
}

TEST(AccuracyCost, RankCorrelationOfAgreeingAndOpposedErrors) {
    std::vector<RunSummary> runs;
    for (int i = 0; i < 9; ++i) {
        RunSummary r = run(1, i * i);
        r.errors[ErrorKind::AliasingBound] = i;
        r.errors[ErrorKind::ShadowEdge] = -i;
        runs.push_back(r);
    }
    EXPECT_NEAR(correlation(runs, kKind, ErrorKind::AliasingBound).rank, 1.0, 1e-12);
    EXPECT_TRUE(correlation(runs, kKind, ErrorKind::AliasingBound).outliers.empty());
    const Correlation opposed = correlation(runs, kKind, ErrorKind::ShadowEdge);
    EXPECT_NEAR(opposed.rank, -1.0, 1e-12);
    EXPECT_EQ(opposed.outliers, (std::vector<std::size_t>{0, 1, 2, 6, 7, 8}));
}

TEST(ErrorKinds, HaveKeysAndLabelsOfTheirOwn) {
    std::set<std::string_view> names;
    for (const ErrorKind kind : kErrorKinds) {
        EXPECT_FALSE(key(kind).empty());
        EXPECT_EQ(key(kind).find(' '), std::string_view::npos) << "it is a name in a document";
        EXPECT_TRUE(names.insert(key(kind)).second) << key(kind);
        EXPECT_TRUE(names.insert(label(kind)).second) << label(kind);
    }
}

TEST(RandomErrors, AreComparedByTheFirstThatAllRunsKnow) {
    Random random(6);
    for (int trial = 0; trial < 1000; ++trial) {
        const std::vector<RunSummary> runs = anyRuns(random);
        std::vector<RunSummary> withMaps;
        for (const RunSummary& run : runs)
            if (run.shadowMaps > 0) withMaps.push_back(run);
        ErrorKind expected = ErrorKind::AliasingBound;
        if (!withMaps.empty() && allKnow(withMaps, ErrorKind::ShadowEdge)) expected = ErrorKind::ShadowEdge;
        if (!withMaps.empty() && allKnow(withMaps, ErrorKind::WrongShadow)) expected = ErrorKind::WrongShadow;
        EXPECT_EQ(shadowError(runs), expected);
    }
}

/// The rank of each value by counting: how many are less, and half of its equals beside it.
std::vector<double> countedRanks(const std::vector<double>& values) {
    std::vector<double> ranks;
    for (const double value : values) {
        const auto less = std::count_if(values.begin(), values.end(), [&](double v) { return v < value; });
        const auto equal = std::count(values.begin(), values.end(), value);
        ranks.push_back(static_cast<double>(less) + (static_cast<double>(equal) - 1) / 2);
    }
    return ranks;
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(RandomErrors, CorrelateByTheirCountedRanks) {
    Random random(7);
    for (int trial = 0; trial < 1000; ++trial) {
        const std::vector<RunSummary> runs = anyRuns(random);
        std::vector<double> a;
        std::vector<double> b;
        std::vector<std::size_t> both;
        for (std::size_t i = 0; i < runs.size(); ++i) {
            if (!knows(runs[i], ErrorKind::AliasingBound) || !knows(runs[i], ErrorKind::WrongShadow)) continue;
            both.push_back(i);
            a.push_back(runs[i].errors.at(ErrorKind::AliasingBound));
            b.push_back(runs[i].errors.at(ErrorKind::WrongShadow));
        }
        const Correlation found = correlation(runs, ErrorKind::AliasingBound, ErrorKind::WrongShadow);
        EXPECT_EQ(found.runs, both.size());
        EXPECT_LE(std::abs(found.rank), 1 + 1e-12);
        if (both.size() < 3) {
            EXPECT_EQ(found.rank, 0);
            EXPECT_TRUE(found.outliers.empty());
            continue;
        }
        const std::vector<double> ranksA = countedRanks(a);
        const std::vector<double> ranksB = countedRanks(b);
        double product = 0;
        double squareA = 0;
        double squareB = 0;
        std::vector<std::size_t> outliers;
        for (std::size_t i = 0; i < both.size(); ++i) {
            product += (ranksA[i] - mean(ranksA)) * (ranksB[i] - mean(ranksB));
            squareA += std::pow(ranksA[i] - mean(ranksA), 2);
            squareB += std::pow(ranksB[i] - mean(ranksB), 2);
            if (3 * std::abs(ranksA[i] - ranksB[i]) > static_cast<double>(both.size())) outliers.push_back(both[i]);
        }
        const double expected = squareA > 0 && squareB > 0 ? product / std::sqrt(squareA * squareB) : 0;
        EXPECT_NEAR(found.rank, expected, 1e-12);
        EXPECT_EQ(found.outliers, outliers);
    }
}

TEST(RandomErrors, DominateInOneDirectionOnly) {
    Random random(8);
    for (int trial = 0; trial < 500; ++trial) {
        const std::vector<RunSummary> runs = anyRuns(random);
        for (const RunSummary& a : runs)
            for (const RunSummary& b : runs)
                for (const ErrorKind kind : kErrorKinds) {
                    if (!dominates(a, b, kind)) continue;
                    EXPECT_FALSE(dominates(b, a, kind));
                    EXPECT_TRUE(knows(a, kind) && knows(b, kind));
                    for (const RunSummary& c : runs)
                        EXPECT_TRUE(!dominates(b, c, kind) || dominates(a, c, kind));
                }
    }
}

} // namespace
} // namespace gnomon::report
