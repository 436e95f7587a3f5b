#include "core/random.h"
#include "exact/float_rounding.h"

#include <gtest/gtest.h>

namespace gnomon::exact {
namespace {

TEST(FloatRounding, IsTheNextFloatInItsDirection) {
    Random random(1);
    for (int i = 0; i < 10000; ++i) {
        const double value = std::ldexp(random.uniform(-1, 1), static_cast<int>(random.below(80)) - 40);
        const float down = roundedDown(value);
        const float up = roundedUp(value);
        EXPECT_LE(down, value);
        EXPECT_GE(up, value);
        const bool isFloat = static_cast<double>(down) == value;
        EXPECT_EQ(up, isFloat ? down : std::nextafter(down, std::numeric_limits<float>::infinity())) << value;
    }
    EXPECT_EQ(roundedDown(0.5), 0.5F);
    EXPECT_EQ(roundedUp(0.5), 0.5F);
}

} // namespace
} // namespace gnomon::exact
