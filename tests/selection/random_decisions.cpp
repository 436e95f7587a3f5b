// Decisions of the cut where chance rounds: a program of its own, in which each function of the error rule, inlined or
// not, sets a rounding mode by chance where it begins and where it ends.
#include "decision_cases.h"
#include "tests/chance_rounding.h"

#include <cstdlib>
#include <iostream>
#include <string>

namespace gnomon::selection {
namespace {

std::uint64_t asked(const char* variable, std::uint64_t otherwise) {
    const char* const text = std::getenv(variable);
    return text == nullptr ? otherwise : std::stoull(text);
}

TEST(Rounding, ChanceDecidesNothingOtherwiseUnreported) {
    Random random(asked("GNOMON_ROUNDING_SEED", 1));
    tests::DecisionCounts counts;
    for (std::uint64_t i = asked("GNOMON_ROUNDING_DECISIONS", 10000); i > 0 && !testing::Test::HasFailure(); --i)
        tests::expectSameDecisions<tests::ChanceRounding>(random, i, counts);
    std::cout << counts.decisions << " decisions, most of them set beside a rounding, " << counts.undecided
              << " undecided, " << counts.changed << " made otherwise\n";
    EXPECT_GT(tests::ChanceRounding::count(), counts.decisions * 100);
}

} // namespace
} // namespace gnomon::selection
