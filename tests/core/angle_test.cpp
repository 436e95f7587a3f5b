#include "core/angle.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(Angle, DegreesAndRadiansAreEachOthersInverse) {
    EXPECT_EQ(radiansFromDegrees(180), kPi);
    EXPECT_EQ(degreesFromRadians(kPi / 2), 90);
    EXPECT_EQ(radiansFromDegrees(0), 0);
    for (int degrees = -720; degrees <= 720; degrees += 7)
        EXPECT_NEAR(degreesFromRadians(radiansFromDegrees(degrees)), degrees, 1e-12);
}

} // namespace
} // namespace gnomon
