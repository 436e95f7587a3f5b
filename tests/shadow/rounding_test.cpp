// Theory and set-up under every rounding mode, and what no build may take away from floating point.
#include "rounding_cases.h"
#include "tests/rounding.h"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

namespace gnomon::shadow {
namespace {

TEST(Rounding, ModesChangeNoSetUpUnreported) {
    Random random(asked("GNOMON_ROUNDING_SEED", 1));
    RoundingCounts counts;
    for (std::uint64_t i = asked("GNOMON_ROUNDING_VIEWS", 1500); i > 0 && !testing::Test::HasFailure(); --i) {
        SCOPED_TRACE(counts.views);
        expectSame<tests::RoundingMode>(random, {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}, counts);
    }
    report(counts);
    EXPECT_LT(counts.undecided * 10, counts.points);
}

#ifdef __FAST_MATH__
#error "fast math: the compiler may take NaN and infinity for impossible, and sums for associative"
#endif

/// What a compiler cannot know.
template <class Number>
Number opaque(Number value) {
    volatile Number kept = value;
    return kept;
}

template <class Number>
bool keepsSubnormals() {
    const Number tiny = opaque(std::numeric_limits<Number>::min());
    const Number less = opaque(tiny / 2);        // flush to zero would make it 0
    return less > 0 && opaque(less * 2) == tiny; // and so would denormals are zero here
}

TEST(Rounding, NobodyFlushesSubnormalsOrTakesSumsForAssociative) {
    const auto check = [] {
        EXPECT_TRUE(keepsSubnormals<float>());
        EXPECT_TRUE(keepsSubnormals<double>());
        EXPECT_EQ(std::fegetround(), FE_TONEAREST);
        const double huge = opaque(0x1p60);
        EXPECT_EQ(opaque(opaque(1.0) + huge) - huge, 0);
        EXPECT_TRUE(
            opaque(std::numeric_limits<double>::quiet_NaN()) != opaque(std::numeric_limits<double>::quiet_NaN()));
    };
    check();
    std::thread(check).join();
}

} // namespace
} // namespace gnomon::shadow
