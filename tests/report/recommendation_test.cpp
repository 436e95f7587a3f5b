// The recommended run against brute force over 500 random sets of runs.
#include "core/random.h"
#include "report/cited.h"
#include "report/recommendation.h"
#include "tests/report/random_runs.h"

#include <gtest/gtest.h>

#include <limits>
#include <regex>
#include <set>

namespace gnomon::report {
namespace {

/// The indices of the runs of `group` that fulfil `request`, by the definition.
std::vector<std::size_t> allowedIn(
    const std::vector<std::size_t>& group, const std::vector<RunSummary>& runs, const Request& request) {
    double fastest = std::numeric_limits<double>::infinity();
    for (const std::size_t i : group)
        fastest = std::min(fastest, runs[i].p50Ms);
    std::vector<std::size_t> result;
    for (const std::size_t i : group) {
        const bool isKnown = knows(runs[i], ErrorKind::WrongPixels);
        if (!isKnown && !runs[i].settings.contains("cells")) continue;
        const double wrong = isKnown ? runs[i].errors.at(ErrorKind::WrongPixels) : 0;
        const double ms = runs[i].p50Ms * (1 + runs[i].noise.value_or(0));
        bool isAllowed = (!request.budgetMs || ms <= *request.budgetMs) &&
                         (!request.maxWrongPixels || wrong <= *request.maxWrongPixels);
        if (!request.budgetMs && !request.maxWrongPixels) isAllowed = runs[i].p50Ms <= 2 * fastest;
        if (isAllowed) result.push_back(i);
    }
    return result;
}

/// The indices of the runs that fulfil `request`: of the most frequent level of detail, else of the finest other one.
/// The random runs have at most two levels. A run in `rejected` does not count.
std::vector<std::size_t> allowed(
    const std::vector<RunSummary>& runs, const Request& request, const std::set<std::size_t>& rejected = {}) {
    std::map<std::string, std::vector<std::size_t>> groups; // the random values sort as texts
    for (std::size_t i = 0; i < runs.size(); ++i)
        groups[runs[i].settings.at("error_pixels")].push_back(i);
    std::vector<std::vector<std::size_t>> order;
    order.reserve(groups.size());
    for (const auto& [detail, which] : groups)
        order.push_back(which);
    if (order.size() == 2 && order[1].size() > order[0].size()) std::swap(order[0], order[1]);
    if (!request.budgetMs && !request.maxWrongPixels) order.resize(std::min<std::size_t>(order.size(), 1));
    for (const auto& group : order) {
        std::vector<std::size_t> result = allowedIn(group, runs, request);
        std::erase_if(result, [&](std::size_t i) { return rejected.contains(i); });
        if (!result.empty()) return result;
    }
    return {};
}

double wrongOf(const RunSummary& run) {
    return knows(run, ErrorKind::WrongPixels) ? run.errors.at(ErrorKind::WrongPixels) : 0;
}

Request anyRequest(Random& random) {
    Request request;
    if (random.below(2) == 0) request.maxWrongPixels = static_cast<double>(random.below(12)) / 8;
    if (random.below(2) == 0) request.budgetMs = random.uniform(5, 320);
    return request;
}

TEST(RandomRecommendation, IsTheBestOfTheAllowedRuns) {
    Random random(21);
    std::set<int> seen; // kinds of requests that had a result, and exact runs that won
    for (int trial = 0; trial < 500; ++trial) {
        const std::vector<RunSummary> runs = anyRuns(random);
        const Request request = anyRequest(random);
        const auto choice = recommend(runs, request);
        const std::vector<std::size_t> all = allowed(runs, request);
        ASSERT_EQ(choice.has_value(), !all.empty());
        if (!choice) {
            EXPECT_TRUE(reasonForNone(runs, request).starts_with("No run is recommended: "));
            continue;
        }
        seen.insert((request.maxWrongPixels ? 1 : 0) + (request.budgetMs ? 2 : 0));
        if (isExact(runs[*choice])) seen.insert(4);
        EXPECT_NE(std::find(all.begin(), all.end(), *choice), all.end());
        for (const std::size_t i : all) {
            if (request.maxWrongPixels) {
                EXPECT_LE(runs[*choice].p50Ms, runs[i].p50Ms);
            } else {
                EXPECT_LE(wrongOf(runs[*choice]), wrongOf(runs[i]));
            }
        }
    }
    EXPECT_EQ(seen, (std::set<int>{0, 1, 2, 3, 4}));
}

TEST(RandomRecommendation, SaysNumbersThatFulfilTheRequest) {
    Random random(22);
    static const std::regex timeFirst("Of the runs (?:with a pixel error of [12] )?with at most ([0-9.]+)% wrong "
                                      "pixels(?: and within ([0-9.]+) ms)? it has the shortest frame time: "
                                      "([0-9.]+) ms, ([0-9.]+)% wrong pixels\\.");
    static const std::regex errorFirst(
        "Of the runs (?:with a pixel error of [12] )?(?:within ([0-9.]+) ms|that take at "
        "most 2 times the frame time of the fastest run \\(([0-9.]+) "
        "ms\\)) it has the fewest wrong pixels: ([0-9.]+)%, ([0-9.]+) ms\\.");
    for (int trial = 0; trial < 500; ++trial) {
        std::vector<RunSummary> runs = anyRuns(random);
        for (RunSummary& run : runs) { // long numbers, so that rounding matters
            run.p50Ms *= random.uniform(0.9, 1.1);
            for (auto& [kind, error] : run.errors)
                error *= random.uniform(0, 0.1);
        }
        Request request = anyRequest(random);
        if (request.maxWrongPixels) *request.maxWrongPixels *= random.uniform(0, 0.1);
        const auto run = recommend(runs, request);
        if (!run) continue;
        const std::string reason = reasonFor(*run, runs, request);
        std::smatch m;
        double ms = 0;
        double percent = 0;
        if (std::regex_match(reason, m, timeFirst)) {
            ms = std::stod(m[3]);
            percent = std::stod(m[4]);
            EXPECT_LE(percent, std::stod(m[1])) << reason;
            EXPECT_LE(ms, m[2].matched ? std::stod(m[2]) : ms) << reason;
        } else {
            ASSERT_TRUE(std::regex_match(reason, m, errorFirst)) << reason;
            ms = std::stod(m[4]);
            percent = std::stod(m[3]);
            EXPECT_LE(ms, m[1].matched ? std::stod(m[1]) : 2 * std::stod(m[2])) << reason;
        }
        EXPECT_NEAR(ms, runs[*run].p50Ms, 0.005 * ms) << reason;
        EXPECT_NEAR(percent, 100 * wrongOf(runs[*run]), 0.005 * percent) << reason;
    }
}

TEST(RandomRecommendation, IsConfirmedByASecondWalk) {
    Random random(23);
    int retried = 0;
    for (int trial = 0; trial < 500; ++trial) {
        const std::vector<RunSummary> runs = anyRuns(random);
        std::vector<RunSummary> again = runs;
        for (RunSummary& run : again)
            run.p50Ms *= random.uniform(0.8, 1.5);
        const Request request{std::nullopt, random.uniform(5, 320)};
        int walks = 0;
        const auto choice = recommendConfirmed(runs, request, [&](std::size_t i) {
            ++walks;
            return again[i];
        });
        std::set<std::size_t> slowAgain;
        for (std::size_t i = 0; i < runs.size(); ++i)
            if (timeToExpectMs(again[i]) > *request.budgetMs) slowAgain.insert(i);
        const std::vector<std::size_t> twice = allowed(runs, request, slowAgain);
        ASSERT_EQ(choice.has_value(), !twice.empty());
        if (!choice) continue;
        retried += walks > 1 ? 1 : 0;
        EXPECT_EQ(choice->p50MsAgain, again[choice->run].p50Ms);
        for (const std::size_t i : twice)
            EXPECT_LE(wrongOf(runs[choice->run]), wrongOf(runs[i]));
    }
    EXPECT_GT(retried, 10);
}

TEST(Recommendation, CanBeExactShadowsWithoutABound) {
    RunSummary exact;
    exact.options = "--shadows exact";
    exact.settings = {{"cells", "map+w"}};
    exact.p50Ms = 30.7;
    RunSummary maps;
    maps.options = "--shadows maps";
    maps.p50Ms = 37;
    maps.errors = {{ErrorKind::AliasingBound, 4.96}};
    EXPECT_EQ(
        recommendationText(std::vector{exact, maps}),
        "recommended: --shadows exact. Of the runs that take at most 2 times the frame time of the fastest run (30.7 "
        "ms) "
        "it has the fewest wrong pixels: 0%, 30.7 ms.");
    EXPECT_EQ(
        recommendationText(std::vector{maps}), "No run is recommended: no run was compared with the ground truth.");
    maps.errors[ErrorKind::WrongPixels] = 0.00645;
    EXPECT_EQ(
        recommendationText(std::vector{exact, maps}, {0.01, std::nullopt}),
        "recommended: --shadows exact. Of the runs with at most 1% wrong pixels it has the shortest frame time: 30.7 "
        "ms, "
        "0% wrong pixels.");
    EXPECT_EQ(
        recommendationText(std::vector{maps}, {0.001, 100}),
        "No run is recommended: there is no run with at most 0.1% wrong pixels and within 100 ms.");
}

// A coarse model is drawn with right shadows of its own, so its few wrong pixels are no reason to recommend it.
TEST(Recommendation, ComparesOneLevelOfDetail) {
    RunSummary fine;
    fine.settings = {{"error_pixels", "1"}};
    fine.p50Ms = 30;
    fine.errors = {{ErrorKind::WrongPixels, 0.01}};
    RunSummary coarse = fine;
    coarse.settings = {{"error_pixels", "8"}};
    coarse.p50Ms = 10;
    coarse.errors = {{ErrorKind::WrongPixels, 0.005}};
    EXPECT_EQ(recommend(std::vector{coarse, fine}), 1U);
    EXPECT_EQ(recommend(std::vector{coarse, fine, coarse}), 0U);
    EXPECT_EQ(runsOfOneDetail(std::vector{coarse, fine, coarse, fine}), (std::vector<std::size_t>{1, 3}));
    EXPECT_EQ(recommend(std::vector<RunSummary>()), std::nullopt);
    const Request budget{std::nullopt, 20};
    EXPECT_EQ(recommend(std::vector{coarse, fine}, budget), 0U) << "only the coarse model is within the budget";
    EXPECT_EQ(
        reasonFor(0, std::vector{coarse, fine}, budget),
        "Of the runs with a pixel error of 8 within 20 ms it has the fewest wrong pixels: 0.5%, 10 ms.");
}

TEST(Cited, HasThreeDigitsWithoutAnExponent) {
    EXPECT_EQ(cited(0), "0");
    EXPECT_EQ(cited(0.00000012344), "0.000000123");
    EXPECT_EQ(cited(30.70), "30.7");
    EXPECT_EQ(cited(12345.6), "12346");
    EXPECT_EQ(cited(100), "100");
    EXPECT_EQ(citedPercent(0.00645), "0.645%");
    EXPECT_EQ(citedBelow(0.12355, 0.1236), "0.1235");
}

} // namespace
} // namespace gnomon::report
