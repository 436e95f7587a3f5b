// The sentences of a report against its table: whatever the runs are, nothing is said that a reader could refute.
#include "core/random.h"
#include "report/accuracy_cost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <set>

namespace gnomon::report {
namespace {

std::vector<ErrorKind> shadowKinds() {
    return {ErrorKind::WrongShadow, ErrorKind::ShadowEdge, ErrorKind::PromisedAliasing};
}

/// Runs of few and often equal values: several of one number of maps, some of other settings, some that know little.
std::vector<RunSummary> anyRuns(Random& random) {
    std::vector<RunSummary> runs(random.below(9));
    const bool knowsAll = random.below(2) == 0;
    for (RunSummary& run : runs) {
        run.shadowMaps = static_cast<int>(random.below(9));
        run.p50Ms = static_cast<double>(1 + random.below(30)) * 10;
        run.settings = {
            {"warp", random.below(5) == 0 ? "none" : "auto"},
            {"shadow_maps", std::to_string(run.shadowMaps)},
            {"z_partitions", std::to_string(run.shadowMaps)}};
        for (const ErrorKind kind : kErrorKinds)
            if (knowsAll || random.below(4) != 0) run.errors[kind] = static_cast<double>(random.below(12)) / 8;
        if (random.below(12) == 0) run.errors[ErrorKind::WrongShadow] = std::numeric_limits<double>::quiet_NaN();
    }
    return runs;
}

bool knows(const RunSummary& run, ErrorKind kind) {
    const auto found = run.errors.find(kind);
    return found != run.errors.end() && std::isfinite(found->second);
}

bool allKnow(const std::vector<RunSummary>& runs, ErrorKind kind) {
    return std::all_of(runs.begin(), runs.end(), [&](const RunSummary& run) { return knows(run, kind); });
}

/// The runs that a reader would compare for what more maps do: like the first but for the number of maps, the fastest
/// of each number.
std::vector<const RunSummary*> comparable(const std::vector<RunSummary>& runs, int maps) {
    std::vector<const RunSummary*> found;
    for (const RunSummary& run : runs)
        if (run.shadowMaps == maps && run.settings.at("warp") == runs.front().settings.at("warp"))
            found.push_back(&run);
    return found;
}

double fastest(const std::vector<const RunSummary*>& runs) {
    double ms = std::numeric_limits<double>::infinity();
    for (const RunSummary* run : runs)
        ms = std::min(ms, run->p50Ms);
    return ms;
}

std::string twoDigits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g", value);
    return text.data();
}

/// The numbers of maps that the first sentence compares, by the text alone.
std::pair<int, int> comparedCounts(const std::string& sentence) {
    const int more = sentence.starts_with("One map ") ? 1 : std::atoi(sentence.c_str());
    const std::string before = " times the frame of ";
    const std::string after = sentence.substr(sentence.find(before) + before.size());
    return {after.starts_with("one") ? 1 : std::atoi(after.c_str()), more};
}

TEST(RandomSentences, CostWhatTheTableSays) {
    Random random(1);
    int said = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const std::vector<RunSummary> runs = anyRuns(random);
        const std::vector<std::string> told = sentences(runs);
        if (told.empty()) continue;
        ++said;
        const auto [less, more] = comparedCounts(told[0]);
        EXPECT_LT(less, more) << told[0];
        const double ratio = fastest(comparable(runs, more)) / fastest(comparable(runs, less));
        EXPECT_NE(told[0].find(" cost " + twoDigits(ratio) + " times the frame of "), std::string::npos)
            << told[0] << " but " << ratio;
        for (int maps = 1; maps < less; ++maps)
            EXPECT_TRUE(comparable(runs, maps).empty()) << told[0] << " though there are runs of " << maps;
        for (int maps = std::max(4, less + 1); maps < more; ++maps)
            EXPECT_TRUE(comparable(runs, maps).empty()) << told[0] << " though there are runs of " << maps;
    }
    EXPECT_GT(said, 1000);
}

/// Whether two of `runs`, of `less` and of `more` maps, have errors in the ratio that `sentence` tells of.
bool isToldRatio(const std::vector<RunSummary>& runs, int less, int more, ErrorKind kind, const std::string& sentence) {
    for (const RunSummary* a : comparable(runs, less))
        for (const RunSummary* b : comparable(runs, more)) {
            if (!knows(*a, kind) || !knows(*b, kind) || !(a->errors.at(kind) > 0)) continue;
            const std::string ratio = twoDigits(b->errors.at(kind) / a->errors.at(kind));
            if (sentence.find(" leave " + ratio + " of ") != std::string::npos) return true;
        }
    return false;
}

TEST(RandomSentences, LeaveOfAnErrorWhatTheTableLeaves) {
    Random random(2);
    int said = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const std::vector<RunSummary> runs = anyRuns(random);
        const std::vector<std::string> told = sentences(runs);
        if (told.empty() || told[0].find(" and leave ") == std::string::npos) continue;
        ++said;
        const auto [less, more] = comparedCounts(told[0]);
        const ErrorKind kind = told[0].ends_with("wrong shadow pixels.")    ? ErrorKind::WrongShadow
                               : told[0].ends_with("shadow-edge distance.") ? ErrorKind::ShadowEdge
                                                                            : ErrorKind::PromisedAliasing;
        for (const ErrorKind better : shadowKinds()) {
            if (better == kind) break;
            EXPECT_FALSE(allKnow(runs, better)) << told[0];
        }
        EXPECT_TRUE(isToldRatio(runs, less, more, kind, told[0])) << told[0];
    }
    EXPECT_GT(said, 500);
}

TEST(RandomSentences, CallNoMapsUselessThatWouldLowerTheErrorByATenth) {
    Random random(3);
    int said = 0;
    for (int trial = 0; trial < 6000; ++trial) {
        std::vector<RunSummary> runs = anyRuns(random);
        // One run of each number, so that a reader need not choose.
        std::set<int> seen;
        std::erase_if(runs, [&](const RunSummary& run) { return !seen.insert(run.shadowMaps).second; });
        const std::vector<std::string> told = sentences(runs);
        if (told.size() < 2) continue;
        ++said;
        const int enough = told[1].starts_with("More than one map") ? 1 : std::atoi(told[1].c_str() + 10);
        const ErrorKind kind = shadowError(runs);
        const auto here = comparable(runs, enough);
        ASSERT_EQ(here.size(), 1U) << told[1];
        if (!knows(*here[0], kind)) continue;
        for (const RunSummary& run : runs) {
            const bool isFurther = run.shadowMaps > enough &&
                                   run.settings.at("warp") == runs.front().settings.at("warp") && knows(run, kind);
            if (isFurther) {
                EXPECT_GE(run.errors.at(kind), 0.9 * here[0]->errors.at(kind)) << told[1];
            }
        }
    }
    EXPECT_GT(said, 300);
}

TEST(RandomSentences, HangNotOnTheOrderBehindTheFirstRun) {
    Random random(4);
    for (int trial = 0; trial < 1000; ++trial) {
        std::vector<RunSummary> runs = anyRuns(random);
        for (std::size_t i = 0; i < runs.size(); ++i)
            runs[i].p50Ms += static_cast<double>(i) / 8; // no two alike
        const std::vector<std::string> told = sentences(runs);
        if (runs.size() > 2) std::reverse(runs.begin() + 1, runs.end());
        EXPECT_EQ(sentences(runs), told);
    }
}

TEST(RandomSentences, AreAtMostTwoAndWhole) {
    Random random(5);
    for (int trial = 0; trial < 2000; ++trial) {
        const std::vector<std::string> told = sentences(anyRuns(random));
        EXPECT_LE(told.size(), 2U);
        for (const std::string& sentence : told) {
            EXPECT_TRUE(sentence.ends_with(".")) << sentence;
            EXPECT_EQ(sentence.find("nan"), std::string::npos) << sentence;
            EXPECT_EQ(sentence.find("inf"), std::string::npos) << sentence;
        }
    }
}

// The fewest maps of a sweep may be many already; a run is compared with no run but another one.
TEST(Sentences, OfManyMapsCompareTwoRunsOfThem) {
    RunSummary four;
    four.shadowMaps = 4;
    four.p50Ms = 100;
    four.errors = {{ErrorKind::WrongShadow, 0.02}};
    RunSummary eight = four;
    eight.shadowMaps = 8;
    eight.p50Ms = 150;
    eight.errors = {{ErrorKind::WrongShadow, 0.01}};
    EXPECT_EQ(
        sentences(std::vector{four, eight}),
        (std::vector<std::string>{"8 maps cost 1.5 times the frame of 4 and leave 0.5 of its wrong shadow pixels."}));
}

TEST(RandomErrors, AreComparedByTheFirstThatAllRunsKnow) {
    Random random(6);
    for (int trial = 0; trial < 1000; ++trial) {
        const std::vector<RunSummary> runs = anyRuns(random);
        std::vector<RunSummary> withMaps;
        for (const RunSummary& run : runs)
            if (run.shadowMaps > 0) withMaps.push_back(run);
        ErrorKind expected = ErrorKind::PromisedAliasing;
        if (!withMaps.empty() && allKnow(withMaps, ErrorKind::ShadowEdge)) expected = ErrorKind::ShadowEdge;
        if (!withMaps.empty() && allKnow(withMaps, ErrorKind::WrongShadow)) expected = ErrorKind::WrongShadow;
        EXPECT_EQ(shadowError(runs), expected);
        const bool hasPictures = allKnow(runs, ErrorKind::ImageDifference);
        EXPECT_EQ(comparedError(runs), hasPictures ? ErrorKind::ImageDifference : expected);
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
            if (!knows(runs[i], ErrorKind::PromisedAliasing) || !knows(runs[i], ErrorKind::WrongShadow)) continue;
            both.push_back(i);
            a.push_back(runs[i].errors.at(ErrorKind::PromisedAliasing));
            b.push_back(runs[i].errors.at(ErrorKind::WrongShadow));
        }
        const Correlation found = correlation(runs, ErrorKind::PromisedAliasing, ErrorKind::WrongShadow);
        EXPECT_EQ(found.runs, both.size());
        EXPECT_LE(std::abs(found.rank), 1 + 1e-12);
        if (both.size() < 3) {
            EXPECT_EQ(found.rank, 0);
            EXPECT_TRUE(found.disobedient.empty());
            continue;
        }
        const std::vector<double> ranksA = countedRanks(a);
        const std::vector<double> ranksB = countedRanks(b);
        double product = 0;
        double squareA = 0;
        double squareB = 0;
        std::vector<std::size_t> disobedient;
        for (std::size_t i = 0; i < both.size(); ++i) {
            product += (ranksA[i] - mean(ranksA)) * (ranksB[i] - mean(ranksB));
            squareA += std::pow(ranksA[i] - mean(ranksA), 2);
            squareB += std::pow(ranksB[i] - mean(ranksB), 2);
            if (3 * std::abs(ranksA[i] - ranksB[i]) > static_cast<double>(both.size())) disobedient.push_back(both[i]);
        }
        const double expected = squareA > 0 && squareB > 0 ? product / std::sqrt(squareA * squareB) : 0;
        EXPECT_NEAR(found.rank, expected, 1e-12);
        EXPECT_EQ(found.disobedient, disobedient);
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
