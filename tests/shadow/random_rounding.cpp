// Theory and set-up where chance rounds: a program of its own, in which each function of src/shadow, inlined or not,
// sets a rounding mode drawn from a seeded sequence where it begins and where it ends. An addition of vectors is a
// function.
#include "rounding_cases.h"
#include "tests/support/chance_rounding.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

TEST(Rounding, ChanceChangesNoSetUpUnreported) {
    Random random(asked("GNOMON_ROUNDING_SEED", 1));
    RoundingCounts counts;
    counts.mayChangeLayout = true;
    // To come back to a view: those before it are drawn, and nothing is made of them.
    const std::uint64_t skipped = asked("GNOMON_ROUNDING_SKIPPED", 0);
    for (std::uint64_t view = 0; view < skipped; ++view)
        static_cast<void>(RoundedCase(random));
    const std::uint64_t asGiven = asked("GNOMON_ROUNDING_VIEWS", 1000);
    for (std::uint64_t i = asGiven - std::min(asGiven, skipped); i > 0 && !testing::Test::HasFailure(); --i) {
        SCOPED_TRACE(testing::Message() << "view " << asGiven - i << " of " << asGiven);
        expectSame<tests::ChanceRounding>(random, {i}, counts);
    }
    report(counts);
    EXPECT_GT(tests::ChanceRounding::count(), counts.views * 100);
}

} // namespace
} // namespace gnomon::shadow
