// The bound of one collapse against points strewn on both fans, and the two distances to a triangle against each other.
#include "core/random.h"
#include "preprocess/proximity/triangle_distance.h"
#include "preprocess/simplify/fan_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::simplify {
namespace {

using Corners = std::array<glm::dvec3, 3>;

double distanceTo(const glm::dvec3& p, const Corners& t) {
    return std::sqrt(proximity::distanceToTriangle(p, t[0], t[1], t[2]).square);
}

glm::dvec3 randomVector(Random& random, double size) {
    const double x = random.uniform(-size, size);
    const double y = random.uniform(-size, size);
    const double z = random.uniform(-size, size);
    return {x, y, z};
}

glm::dvec3 randomPoint(const Corners& t, Random& random) {
    double u = random.unit();
    double v = random.unit();
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    return t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v;
}

/// A fan around the origin, from flat and round to folded at random.
Fan randomFan(Random& random) {
    Fan fan;
    fan.count = static_cast<std::uint32_t>(3 + random.below(7));
    fan.isClosed = random.below(3) != 0;
    const double roughness = random.unit() * random.unit() * 1.5;
    fan.apex = randomVector(random, roughness);
    const double turn = fan.isClosed ? 6.28 : random.uniform(1, 6);
    for (std::uint32_t i = 0; i < fan.count; ++i) {
        const double angle = turn * i / (fan.isClosed ? fan.count : fan.count - 1);
        fan.rim.at(i) =
            glm::dvec3(std::cos(angle), std::sin(angle), 0) * random.uniform(0.3, 1) + randomVector(random, roughness);
        fan.fromSource.at(i) = random.below(2) == 0 ? 0 : random.unit();
        fan.toSource.at(i) = random.below(2) == 0 ? 0 : random.unit();
    }
    return fan;
}

std::vector<Corners> oldTriangles(const Fan& fan) {
    std::vector<Corners> triangles;
    for (std::uint32_t i = 0; i + (fan.isClosed ? 0 : 1) < fan.count; ++i)
        triangles.push_back({fan.apex, fan.rim.at(i), fan.rim.at((i + 1) % fan.count)});
    return triangles;
}

Corners newTriangle(const Fan& fan, std::uint32_t j) {
    return {fan.rim[0], fan.rim.at(j), fan.rim.at(j + 1)};
}

/// Every point of old triangle `i` is as near to a new one as that one's bound says.
void expectOldTriangleHeld(const Fan& fan, const FanAfter& after, std::uint32_t i, Random& random) {
    const Corners triangle = oldTriangles(fan)[i];
    for (int sample = 0; sample < 20; ++sample) {
        const glm::dvec3 p = randomPoint(triangle, random);
        bool isHeld = false;
        for (std::uint32_t j = 1; j + 1 < fan.count; ++j)
            isHeld =
                isHeld || distanceTo(p, newTriangle(fan, j)) + fan.fromSource.at(i) <= after.fromSource.at(j) + 1e-12;
        ASSERT_TRUE(isHeld) << "old triangle " << i;
    }
}

/// Every point of new triangle `j` is as near to an old one as its bound says; returns the largest share of the bound
/// that a distance had, where nothing else is in the bound.
double expectNewTriangleHeld(const Fan& fan, const FanAfter& after, std::uint32_t j, Random& random) {
    const std::vector<Corners> before = oldTriangles(fan);
    double tightest = 0;
    for (int sample = 0; sample < 20; ++sample) {
        const glm::dvec3 p = randomPoint(newTriangle(fan, j), random);
        bool isHeld = false;
        for (std::uint32_t i = 0; i < before.size(); ++i) {
            const double found = distanceTo(p, before[i]) + fan.toSource.at(i);
            isHeld = isHeld || found <= after.toSource.at(j) + 1e-12;
            if (fan.toSource.at(i) == 0 && after.toSource.at(j) > 0)
                tightest = std::max(tightest, found / after.toSource.at(j));
        }
        EXPECT_TRUE(isHeld) << "new triangle " << j << " of " << fan.count - 2;
    }
    return tightest;
}

TEST(FanMap, EveryPointOfBothFansIsWithinTheBound) {
    Random random(3);
    double tightest = 0;
    for (int run = 0; run < 2000 && !HasFailure(); ++run) {
        SCOPED_TRACE(run);
        const Fan fan = randomFan(random);
        const FanAfter after = mapFan(fan);
        for (std::uint32_t i = 0; i < oldTriangles(fan).size(); ++i)
            expectOldTriangleHeld(fan, after, i, random);
        for (std::uint32_t j = 1; j + 1 < fan.count; ++j)
            tightest = std::max(tightest, expectNewTriangleHeld(fan, after, j, random));
    }
    EXPECT_GT(tightest, 0.5);
}

TEST(FanMap, AFlatFanDoesNotMoveAtAll) {
    Random random(5);
    for (int run = 0; run < 200; ++run) {
        Fan fan = randomFan(random);
        fan.isClosed = true;
        fan.apex = glm::dvec3(0);
        for (std::uint32_t i = 0; i < fan.count; ++i) {
            const double angle = 6.28 * i / fan.count;
            fan.rim.at(i) = glm::dvec3(std::cos(angle), std::sin(angle), 0);
            fan.fromSource.at(i) = fan.toSource.at(i) = 0;
        }
        const FanAfter after = mapFan(fan);
        for (std::uint32_t j = 1; j + 1 < fan.count; ++j)
            EXPECT_LT(std::max(after.fromSource.at(j), after.toSource.at(j)), 1e-12);
    }
}

TEST(TriangleDistance, TheFastAnswerIsTheSlowOneEvenForSlivers) {
    Random random(17);
    for (int run = 0; run < 20000; ++run) {
        Corners t{randomVector(random, 1), randomVector(random, 1), randomVector(random, 1)};
        if (run % 4 == 1) t[2] = (t[0] + t[1]) * 0.5;
        if (run % 4 == 2) t[2] = t[1];
        if (run % 40 == 3) t[1] = t[2] = t[0];
        const glm::dvec3 p = randomVector(random, 2);
        const double slow = proximity::distanceToTriangle(p, t[0], t[1], t[2]).square;
        EXPECT_NEAR(proximity::squaredDistance(p, t[0], t[1], t[2]), slow, 1e-12) << run;
        double min = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < 3; ++i)
            min = std::min(min, proximity::squaredDistance(p, t.at(i), t.at((i + 1) % 3)));
        EXPECT_GE(min, slow - 1e-12) << run;
    }
}

} // namespace
} // namespace gnomon::simplify
