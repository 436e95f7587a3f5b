// The tree's nearest triangle against a look at every triangle, and the distance against a search over the triangle.
#include "core/random.h"
#include "preprocess/verify/triangle_tree.h"
#include "tests/support/random_point.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::verify {
namespace {

TriangleSoup randomSoup(Random& random, std::uint32_t count, double size) {
    TriangleSoup soup;
    for (std::uint32_t t = 0; t < count; ++t) {
        const glm::dvec3 place = randomPoint(random, 10);
        const bool isDegenerate = random.below(8) == 0;
        const glm::dvec3 end = place + randomPoint(random, size);
        soup.positions.insert(
            soup.positions.end(),
            {place,
             end,
             isDegenerate ? place + (end - place) * random.uniform(-2, 2) : place + randomPoint(random, size)});
        soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return soup;
}

TEST(TriangleTree, FindsWhatALookAtAllFinds) {
    Random random(1);
    for (const std::uint32_t count : {1U, 4U, 5U, 6U, 9U, 1000U, 20000U}) {
        const TriangleSoup soup = randomSoup(random, count, count > 100 ? 0.3 : 5);
        const TriangleTree tree(soup);
        std::uint32_t hint = 0xFFFFFFFFU;
        for (int i = 0; i < (count > 10000 ? 50 : 300); ++i) {
            const glm::dvec3 point = randomPoint(random, 15);
            double min = std::numeric_limits<double>::infinity();
            for (std::uint32_t t = 0; t < count; ++t)
                min = std::min(min, squaredDistance(point, soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2)));
            const TriangleTree::Nearest found = tree.nearest(point, hint);
            EXPECT_DOUBLE_EQ(found.distance, std::sqrt(min));
            hint = found.triangle;
        }
    }
}

TEST(TriangleTree, AnEmptySoupIsInfinitelyFar) {
    const TriangleSoup soup;
    EXPECT_EQ(TriangleTree(soup).nearest({0, 0, 0}).distance, std::numeric_limits<double>::infinity());
}

TEST(SquaredDistance, IsThatOfTheNearestOfManyPoints) {
    Random random(2);
    constexpr int kSteps = 200;
    for (int i = 0; i < 60; ++i) {
        const TriangleSoup soup = randomSoup(random, 1, 4);
        const glm::dvec3 point = soup.positions[0] + randomPoint(random, 4);
        double min = std::numeric_limits<double>::infinity();
        for (int a = 0; a <= kSteps; ++a)
            for (int b = 0; a + b <= kSteps; ++b)
                min = std::min(
                    min,
                    glm::length(
                        point - soup.point(0, static_cast<double>(a) / kSteps, static_cast<double>(b) / kSteps)));
        const double found = std::sqrt(squaredDistance(point, soup.positions[0], soup.positions[1], soup.positions[2]));
        EXPECT_LE(found, min + 1e-12);
        EXPECT_GE(found, min - 0.12);
    }
}

} // namespace
} // namespace gnomon::verify
