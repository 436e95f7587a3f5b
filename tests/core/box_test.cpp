// Boxes and balls against their points.
#include "core/box.h"
#include "core/random.h"
#include "tests/support/random_point.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(Box, IsEmptyUntilSomethingIsAdded) {
    Box box;
    EXPECT_TRUE(box.isEmpty());
    EXPECT_EQ(box.extent(), glm::dvec3(0));
    box.add(Box{});
    EXPECT_TRUE(box.isEmpty()) << "nothing added to nothing";
    box.add({1, 2, 3});
    EXPECT_FALSE(box.isEmpty());
    EXPECT_EQ(box.center(), glm::dvec3(1, 2, 3));
    EXPECT_EQ(box.extent(), glm::dvec3(0));
    for (int axis = 0; axis < 3; ++axis) {
        Box inverted{{0, 0, 0}, {1, 1, 1}};
        inverted.max[axis] = -1;
        EXPECT_TRUE(inverted.isEmpty()) << axis;
    }
}

TEST(Box, HoldsWhatWasAddedAndNoMore) {
    Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
        Box box;
        Box united;
        glm::dvec3 min(9);
        glm::dvec3 max(-9);
        for (int i = 0; i < 5; ++i) {
            const glm::dvec3 a = randomPoint(random, 2);
            const glm::dvec3 b = randomPoint(random, 2);
            box.add(a);
            box.add(b);
            united.add(Box{glm::min(a, b), glm::max(a, b)});
            min = glm::min(min, glm::min(a, b));
            max = glm::max(max, glm::max(a, b));
        }
        EXPECT_EQ(box.min, min);
        EXPECT_EQ(box.max, max);
        EXPECT_EQ(united.min, min);
        EXPECT_EQ(united.max, max);
        EXPECT_EQ(box.extent(), max - min);
        EXPECT_LE(glm::distance(box.center(), (min + max) / 2.0), 1e-15);
    }
}

// The nearest of the points of a fine grid in the box, which is off by no more than the grid's own spacing.
TEST(Box, TheDistanceOfAPointIsThatOfItsNearestPoint) {
    Random random(2);
    constexpr int kSteps = 24;
    for (int trial = 0; trial < 50; ++trial) {
        const glm::dvec3 a = randomPoint(random, 2);
        const glm::dvec3 b = randomPoint(random, 2);
        const Box box{glm::min(a, b), glm::max(a, b)};
        const glm::dvec3 point = 2.0 * randomPoint(random, 2);
        double nearest = 1e9;
        for (int x = 0; x <= kSteps; ++x)
            for (int y = 0; y <= kSteps; ++y)
                for (int z = 0; z <= kSteps; ++z)
                    nearest = std::min(
                        nearest, glm::distance(point, box.min + box.extent() * (glm::dvec3(x, y, z) / double{kSteps})));
        EXPECT_LE(distance(box, point), nearest + 1e-12);
        EXPECT_GE(distance(box, point), nearest - glm::length(box.extent()) / kSteps);
    }
    EXPECT_EQ(distance(Box{{0, 0, 0}, {1, 1, 1}}, {0.5, 1, 0}), 0) << "on its surface";
    EXPECT_EQ(distance(Box{{0, 0, 0}, {1, 1, 1}}, {4, 5, 0.5}), 5);
}

TEST(Sphere, TheDistanceOfAPointIsZeroInside) {
    const Sphere ball{{1, 0, 0}, 2};
    EXPECT_EQ(distance(ball, {1, 0, 0}), 0);
    EXPECT_EQ(distance(ball, {3, 0, 0}), 0);
    EXPECT_EQ(distance(ball, {6, 0, 0}), 3);
    EXPECT_EQ(distance(ball, {1, 3, -4}), 3);
}

} // namespace
} // namespace gnomon
