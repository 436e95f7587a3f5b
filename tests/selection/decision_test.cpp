// What the rule decides for certain, against 200 bits and against itself in every rounding mode.
#include "decision_cases.h"
#include "exact_rule.h"
#include "selection/range.h"
#include "tests/rounding.h"

#include <array>
#include <iostream>

namespace gnomon::selection {
namespace {

using tests::DecisionCase;
using tests::DecisionCounts;
using theory::Real;

constexpr std::array kModes = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

TEST(Range, HoldsWhatEveryModeMakesOfWhatItHolds) {
    Random random(71);
    const auto drawn = [&] { return random.uniform(-1, 1) * std::pow(10.0, random.uniform(-8, 8)); };
    for (int trial = 0; trial < 20000; ++trial) {
        const double x = drawn();
        const double y = drawn();
        const Range a = random.below(2) == 0 ? Range(x) : Range(x - std::abs(drawn()), x + std::abs(drawn()));
        const Range b = random.below(2) == 0 ? Range(y) : Range(y - std::abs(drawn()), y + std::abs(drawn()));
        const std::array<std::pair<Range, Real>, 6> results = {
            {{a + b, Real(x) + y},
             {a - b, Real(x) - y},
             {a * b, Real(x) * y},
             {a / b, Real(x) / y},
             {root(a), x < 0 ? Real(0) : root(Real(x))},
             {least(a, greatest(b, 1)), std::min(x, std::max(y, 1.0))}}};
        for (const auto& [range, exact] : results) {
            EXPECT_LE(Real(range.low), exact);
            EXPECT_GE(Real(range.high), exact);
        }
        for (const int mode : kModes) {
            const tests::RoundingMode rounding(mode);
            const volatile double p = x; // not folded
            const volatile double q = y;
            const std::array<double, 4> made = {p + q, p - q, p * q, p / q};
            for (std::size_t i = 0; i < made.size(); ++i) {
                EXPECT_LE(results.at(i).first.low, made.at(i)) << i;
                EXPECT_GE(results.at(i).first.high, made.at(i)) << i;
            }
        }
    }
    const Range all = Range(1) / Range(-1, 1);
    EXPECT_TRUE(std::isinf(all.low) && std::isinf(all.high));
    EXPECT_EQ((Range(0) * all).high, std::numeric_limits<double>::min()) << "nothing is nothing, however often";
}

TEST(CertainRule, HoldsTheExactPixelsAndIsNarrow) {
    Random random(72);
    int positive = 0;
    int narrow = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const DecisionCase one(random);
        const ErrorRule rule(one.view, one.casters);
        const Range range = CertainRule(rule).pixels(one.bounds, one.error);
        const Real exact = tests::exactPixels(rule, one.bounds, one.error);
        EXPECT_LE(Real(range.low), exact) << trial;
        EXPECT_GE(Real(range.high), exact) << trial;
        if (!(exact > Real(0))) continue;
        ++positive;
        narrow += range.high - range.low <= 1e-6 * range.high ? 1 : 0;
    }
    EXPECT_GT(positive, 5000);
    EXPECT_GT(narrow, positive * 0.7) << "a third of the cases touch a plane but for a rounding";
}

TEST(CertainRule, NoRoundingModeDecidesOtherwiseUnreported) {
    Random random(73);
    DecisionCounts counts;
    for (int trial = 0; trial < 20000; ++trial)
        for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
            tests::expectSameDecisions<tests::RoundingMode>(random, mode, counts);
    EXPECT_GT(counts.changed, 500U) << "cases that no rounding changes show nothing";
    EXPECT_LT(counts.changed, counts.undecided);
}

TEST(CertainRule, IsCertainOfWhatIsNoMatterOfRounding) {
    Random random(74);
    DecisionCounts counts;
    for (int trial = 0; trial < 20000; ++trial) {
        const DecisionCase one(random);
        const ErrorRule rule(one.view, one.casters);
        const double pixels = rule.pixels(one.bounds, one.error);
        for (const double threshold : {pixels * 0.999, pixels * 1.001 + 1e-9}) {
            const Decision decision = CertainRule(rule).exceeds(one.bounds, one.error, threshold);
            ++counts.decisions;
            counts.undecided += decision == Decision::Undecided ? 1 : 0;
            if (decision == Decision::Undecided) continue;
            EXPECT_EQ(decision == Decision::Yes, rule.exceeds(one.bounds, one.error, threshold));
        }
    }
    EXPECT_LT(counts.undecided * 4, counts.decisions);
}

TEST(CertainRule, KnowsRootsAndWhatHasNoError) {
    const DetailView view;
    const ErrorRule rule(view);
    const CertainRule certain(rule);
    EXPECT_EQ(certain.exceeds({{0, 0, 9}, 1}, std::numeric_limits<double>::infinity(), 1e300), Decision::Yes);
    EXPECT_EQ(certain.exceeds({{0, 0, -9}, 1}, 0, 0), Decision::No);
    EXPECT_EQ(certain.exceeds({{0, 0, 9}, 1}, 1, 0), Decision::No) << "behind the eye";
    EXPECT_EQ(certain.exceeds({{0, 0, 1}, 1}, 1, 0), Decision::Undecided) << "touches the plane of the eye";
    EXPECT_EQ(certain.exceeds({{0, 0, 1}, std::nextafter(1.0, 2.0)}, 1, 0), Decision::Undecided);
    EXPECT_EQ(certain.exceeds({{0, 0, 1}, 1 + 1e-12}, 1, 0), Decision::Yes);
}

} // namespace
} // namespace gnomon::selection
