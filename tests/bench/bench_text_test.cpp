// The texts of a bench. The recommendation itself is tested in tests/report/recommendation_test.cpp.
#include "bench/bench_text.h"

#include <gtest/gtest.h>

namespace gnomon::bench {
namespace {

using report::ErrorKind;
using report::RunSummary;

/// Exact shadows in 30.7 ms, and maps in 37 ms with 0.645% wrong pixels.
std::vector<RunSummary> exactAndMaps() {
    std::vector<RunSummary> runs(2);
    runs[0].options = "--shadows exact";
    runs[0].settings["cells"] = "map+w";
    runs[0].p50Ms = 30.7;
    runs[1].options = "--shadows maps";
    runs[1].p50Ms = 37;
    runs[1].errors = {{ErrorKind::AliasingBound, 4.96}, {ErrorKind::WrongPixels, 0.00645}};
    return runs;
}

TEST(BenchText, RecommendsExactShadowsThatAreFasterThanMaps) {
    EXPECT_TRUE(recommendationText(exactAndMaps(), std::nullopt).starts_with("recommended: --shadows exact. "));
    EXPECT_EQ(recommendationText(std::vector{exactAndMaps()[0]}, std::nullopt), "") << "nothing to choose from";
    EXPECT_TRUE(recommendationText(std::vector{exactAndMaps()[1]}, 0.001).starts_with("No run is recommended: "));
}

TEST(BenchText, NamesARunWithinTheBudgetThatIsFastTwice) {
    const std::vector<RunSummary> runs = exactAndMaps();
    const auto again = [&](std::size_t run) {
        RunSummary walked = runs[run];
        if (run == 0) walked.p50Ms = 41; // slower in the second measurement
        return walked;
    };
    const BudgetChoice choice = underBudget({std::nullopt, 40}, runs, again);
    EXPECT_TRUE(choice.hasRun);
    EXPECT_EQ(
        choice.text,
        "budget: --shadows maps. Of the runs within 40 ms it has the fewest wrong pixels: 0.645%, 37 ms. In a second "
        "measurement it took 37 ms.\n");
    const BudgetChoice none = underBudget({std::nullopt, 0.1}, runs, again);
    EXPECT_FALSE(none.hasRun);
    EXPECT_EQ(
        none.text, "budget: No run is recommended: there is no run within 0.1 ms. The fastest run takes 30.7 ms.\n");
}

TEST(BenchText, ExactShadowsKeepAnyAliasingBound) {
    EXPECT_EQ(
        underBoundText(1, exactAndMaps()), "fastest with an aliasing bound of at most 1: --shadows exact (30.7 ms)\n");
}

} // namespace
} // namespace gnomon::bench
