// The search finds a narrow peak that was planted, the same one each time, and tells it as simply as can be.
#include "search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace gnomon::torture {
namespace {

/// 2 where the first two of six genes are 0.3 and 0.7, and 1 a millionth from there.
Score peak(Genes genes, Words /*words*/) {
    const double x = genes.unit() - 0.3;
    const double y = genes.unit() - 0.7;
    return {2 / (1 + std::hypot(x, y) * 1e6)};
}

const Objective kPeak{"peak", "", 6, 1, 1, peak};

TEST(WorstSearch, ClimbsANarrowPeakAndTellsItSimply) {
    SearchOptions options;
    options.steps = 20000;
    options.stepsAClimb = 5000;
    const SearchResult result = search(kPeak, options);
    ASSERT_FALSE(result.finds.empty());
    const Found& found = result.finds.front();
    EXPECT_GT(found.value, 1);
    EXPECT_NEAR(found.genes[0], 0.3, 1e-6);
    EXPECT_NEAR(found.genes[1], 0.7, 1e-6);
    for (std::size_t i = 2; i < found.genes.size(); ++i)
        EXPECT_EQ(found.genes[i], 0) << "what changes nothing is left out";
    EXPECT_EQ(search(kPeak, options), result);
    options.seed = 2;
    EXPECT_NE(search(kPeak, options), result);
}

TEST(WorstSearch, EndsWithinAClimbWhenItsTimeIsOver) {
    SearchOptions options;
    options.steps = 20000;
    options.stepsAClimb = 5000;
    std::uint64_t asked = 0;
    options.isOver = [&] { return ++asked == 7; };
    const SearchResult result = search(kPeak, options);
    EXPECT_EQ(result.steps, 7U);
    EXPECT_EQ(result.climbs, 1U);
    options.isOver = [] { return true; };
    EXPECT_EQ(search(kPeak, options).steps, 1U) << "says something however little time there is";
    options.steps = 7;
    options.isOver = {};
    EXPECT_EQ(search(kPeak, options), result) << "what was found until then is that of as many steps";
}

TEST(SlowWorstSearch, NoObjectiveIsBrokenByAFewCasesAndAllCanBeToldInWords) {
    std::vector<Objective> objectives = viewObjectives();
    for (const Objective& objective : meshObjectives())
        objectives.push_back(objective);
    std::set<std::string> names;
    for (const Objective& objective : objectives) {
        EXPECT_TRUE(names.insert(objective.name).second);
        SearchOptions options;
        options.steps = 4;
        const SearchResult result = search(objective, options);
        EXPECT_TRUE(result.finds.empty()) << objective.name;
        const Score told = objective.score(Genes(result.worst.genes), Words::Yes);
        EXPECT_EQ(told.value, result.worst.value) << objective.name << " is not pure";
        EXPECT_FALSE(told.where.empty()) << objective.name;
    }
}

} // namespace
} // namespace gnomon::torture
