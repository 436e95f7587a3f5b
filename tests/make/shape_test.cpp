// The statue's shape: a distance that a march can trust, and a table of its surface that lies on it.
#include "core/random.h"
#include "preprocess/make/bust_shape.h"
#include "preprocess/make/statue_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::make {
namespace {

TEST(BustShape, HasAnInsideAndAnOutside) {
    for (const std::uint64_t seed : {1U, 2U, 77U}) {
        const BustShape shape(seed);
        EXPECT_LT(shape.distance({0, 0.1, 0}), 0) << "in the plinth";
        EXPECT_LT(shape.distance({0, 0.6, 0}), 0) << "in the head";
        EXPECT_GT(shape.distance({0, 1.2, 0}), 0.2) << "above it";
        EXPECT_GT(shape.distance({1, 0.4, 0}), 0.3);
        EXPECT_GT(shape.distance({0, 0.4, 1}), 0.3);
    }
}

// A march inwards of 0.6 of the distance must not jump over the surface.
TEST(BustShape, ItsSlopeLetsAMarchTrustIt) {
    const BustShape shape(1);
    Random random(1);
    std::vector<double> slopes;
    for (int i = 0; i < 40000; ++i) {
        const glm::dvec3 p(random.uniform(-0.4, 0.4), random.uniform(0, 0.85), random.uniform(-0.4, 0.4));
        const double here = shape.distance(p);
        if (here < 0 || here > 0.02) continue;
        const glm::dvec3 to(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        slopes.push_back(std::abs(shape.distance(p + glm::normalize(to) * 1e-4) - here) / 1e-4);
    }
    ASSERT_GT(slopes.size(), 500U);
    std::sort(slopes.begin(), slopes.end());
    EXPECT_LT(slopes[slopes.size() * 95 / 100], 1 / 0.6) << "but in the sharpest of its folds";
    EXPECT_GT(slopes.back(), 0.9) << "and it is no constant";
}

class Surface : public testing::Test {
protected:
    static const StatueSurface& shared() {
        static const StatueSurface surface(1);
        return surface;
    }
};

TEST_F(Surface, LiesOnTheShape) {
    const BustShape shape(1);
    Random random(2);
    std::vector<double> away;
    for (int i = 0; i < 2000; ++i) {
        const auto along = static_cast<float>(random.uniform(shared().baseEnd(), 1));
        const SurfacePoint point = shared().at(along, static_cast<float>(random.uniform(0, 4)));
        away.push_back(std::abs(shape.distance(glm::dvec3(point.position))));
        EXPECT_NEAR(glm::length(point.outward), 1, 1e-3);
    }
    std::sort(away.begin(), away.end());
    EXPECT_LT(away[away.size() / 2], 0.001) << "a millimetre";
    EXPECT_LT(away.back(), 0.03) << "and nowhere far, where the table is coarser than the carving";
}

TEST_F(Surface, ClosesAroundAndRunsFromBaseToCrown) {
    const float width = shared().crownBegin() - shared().baseEnd();
    ASSERT_GT(width, 0.5F);
    for (const float along : {0.1F, 0.4F, 0.7F, 0.95F}) {
        const glm::vec3 first = shared().at(along, 0).position;
        const glm::vec3 last = shared().at(along, 3.9999F).position;
        EXPECT_LT(glm::distance(first, last), 0.01F) << "four quarter turns";
    }
    EXPECT_LT(shared().at(0.001F, 1).position.y, 0.05F);
    EXPECT_GT(shared().at(0.999F, 1).position.y, 0.7F);
    // The outward directions point away from the axis through the body.
    int outwards = 0;
    for (int i = 0; i < 400; ++i) {
        const SurfacePoint point = shared().at(0.3F + 0.0005F * static_cast<float>(i), 0.01F * static_cast<float>(i));
        outwards += point.outward.x * point.position.x + point.outward.z * point.position.z > -0.05F ? 1 : 0;
    }
    EXPECT_GT(outwards, 360);
}

TEST_F(Surface, KnowsItsAreaAndItsLength) {
    double sum = 0;
    constexpr int kRows = 200;
    constexpr int kColumns = 400;
    const auto at = [&](int row, int column) {
        return glm::dvec3(
            shared()
                .at(static_cast<float>(row) / kRows, 4.0F * static_cast<float>(column % kColumns) / kColumns)
                .position);
    };
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            const glm::dvec3 a = at(row, column);
            const glm::dvec3 c = at(row + 1, column + 1);
            sum += glm::length(glm::cross(at(row, column + 1) - a, c - a)) / 2;
            sum += glm::length(glm::cross(c - a, at(row + 1, column) - a)) / 2;
        }
    EXPECT_NEAR(shared().area(), sum, 0.1 * sum);
    EXPECT_GT(shared().meridian(), 0.8) << "longer than it is high";
    EXPECT_LT(shared().meridian(), 3);
}

} // namespace
} // namespace gnomon::make
