// The recommendation of a bench against its numbers, for seeded sets of runs.
#include "bench/bench_text.h"
#include "core/random.h"
#include "report/accuracy_cost.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::bench {
namespace {

using report::ErrorKind;
using report::RunSummary;

/// Runs with ties and noise, with and without exact shadows, some without a reference.
std::vector<RunSummary> anyRuns(Random& random) {
    std::vector<RunSummary> runs(1 + random.below(6));
    const bool hasReference = random.below(3) > 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        RunSummary& run = runs[i];
        run.name = "run " + std::to_string(i);
        run.options = "option" + std::to_string(i);
        run.p50Ms = 10 + static_cast<double>(random.below(8)) * 5;
        if (random.below(2) == 0) run.noise = 0.01 * static_cast<double>(random.below(10));
        const bool isExact = random.below(4) == 0;
        if (isExact) run.settings["cells"] = "map+w";
        if (isExact)
            run.errors[ErrorKind::WrongPixels] = 0;
        else if (hasReference)
            run.errors[ErrorKind::WrongPixels] = 0.001 * static_cast<double>(random.below(6));
        if (!isExact) run.errors[ErrorKind::AliasingBound] = 1 + random.unit();
        if (!isExact) run.shadowMaps = 1 + static_cast<int>(random.below(4));
    }
    return runs;
}

const RunSummary* namedIn(const std::string& text, const std::vector<RunSummary>& runs) {
    for (const RunSummary& run : runs)
        if (text.find(run.options + " (") != std::string::npos) return &run;
    return nullptr;
}

TEST(RandomRecommendation, IsTheCheapestAtTheRequestedAccuracy) {
    Random random(1);
    for (int trial = 0; trial < 500; ++trial) {
        const auto runs = anyRuns(random);
        const double max = 0.001 * static_cast<double>(random.below(5));
        const std::string text = recommendationText(runs, max);
        const bool isAny = std::any_of(runs.begin(), runs.end(), [&](const RunSummary& run) {
            return report::knownError(run, ErrorKind::WrongPixels).value_or(1) <= max;
        });
        EXPECT_EQ(text.starts_with("recommended: "), isAny) << text;
        if (!isAny) continue;
        const RunSummary* const chosen = namedIn(text, runs);
        ASSERT_NE(chosen, nullptr) << text;
        EXPECT_LE(*report::knownError(*chosen, ErrorKind::WrongPixels), max);
        for (const RunSummary& run : runs)
            if (report::knownError(run, ErrorKind::WrongPixels).value_or(1) <= max) {
                EXPECT_LE(chosen->p50Ms, run.p50Ms);
            }
    }
}

// Whatever is recommended, no other run is at least as accurate, measurably faster, and known.
TEST(RandomRecommendation, IsNotBeatenAndNeedsKnownErrors) {
    Random random(2);
    int recommended = 0;
    for (int trial = 0; trial < 500; ++trial) {
        const auto runs = anyRuns(random);
        const std::string text = recommendationText(runs, std::nullopt);
        if (runs.size() < 2) EXPECT_EQ(text, "");
        const RunSummary* const chosen = namedIn(text, runs);
        if (chosen == nullptr) continue;
        ++recommended;
        const double error = *report::knownError(*chosen, ErrorKind::WrongPixels);
        for (const RunSummary& run : runs) {
            const auto other = report::knownError(run, ErrorKind::WrongPixels);
            if (!other) {
                EXPECT_TRUE(error == 0 && chosen->p50Ms <= run.p50Ms) << text;
                continue;
            }
            const bool isFaster = report::compareTimes(run, *chosen) == report::TimeOrder::Less;
            EXPECT_FALSE(*other <= error && isFaster) << text;
        }
    }
    EXPECT_GT(recommended, 200);
}

TEST(Recommendation, IsExactWhereItIsFasterAndHasNoWrongPixel) {
    std::vector<RunSummary> runs(2);
    runs[0].options = "--shadows exact";
    runs[0].p50Ms = 30.7;
    runs[0].errors[ErrorKind::WrongPixels] = 0;
    runs[1].options = "--shadows maps";
    runs[1].p50Ms = 37;
    runs[1].errors[ErrorKind::AliasingBound] = 4.96;
    EXPECT_EQ(recommendationText(runs, std::nullopt), "recommended: --shadows exact (30.7 ms, no wrong pixels)\n");
}

TEST(RandomBudget, NamesTheMostAccurateRunWithin) {
    Random random(3);
    for (int trial = 0; trial < 500; ++trial) {
        const auto runs = anyRuns(random);
        const double budget = random.uniform(5, 60);
        const BudgetChoice choice = underBudget(budget, runs, [&](std::size_t run) { return runs[run]; });
        const auto fits = [&](const RunSummary& run) { return report::timeToExpectMs(run) <= budget; };
        const bool isMeasured = std::any_of(runs.begin(), runs.end(), [](const RunSummary& run) {
            return report::knownError(run, ErrorKind::WrongPixels).has_value();
        });
        const auto counts = [&](const RunSummary& run) {
            return fits(run) && (!isMeasured || report::knownError(run, ErrorKind::WrongPixels).has_value());
        };
        EXPECT_EQ(choice.hasRun, std::any_of(runs.begin(), runs.end(), counts)) << choice.text;
        if (!choice.hasRun) continue;
        const RunSummary* const chosen = namedIn(choice.text, runs);
        ASSERT_NE(chosen, nullptr) << choice.text;
        EXPECT_TRUE(fits(*chosen));
        for (const RunSummary& run : runs)
            if (counts(run)) {
                EXPECT_LE(
                    report::knownError(*chosen, ErrorKind::WrongPixels).value_or(0),
                    report::knownError(run, ErrorKind::WrongPixels).value_or(0));
            }
    }
}

} // namespace
} // namespace gnomon::bench
