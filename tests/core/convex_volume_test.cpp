#include "core/convex_volume.h"
#include "core/random.h"
#include "tests/support/rounding.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace gnomon {
namespace {

glm::dvec3 pointInOrOut(Random& random) {
    return {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
}

// The sampled truth beside the plane test: a box whose sample points are inside may not be called outside.
TEST(ConvexVolume, ClassificationIsConservative) {
    Random random(7);
    for (int trial = 0; trial < 2000; ++trial) {
        ConvexVolume volume;
        for (int i = 0; i < 5; ++i) {
            const glm::dvec3 normal = glm::normalize(pointInOrOut(random) + glm::dvec3(1e-9));
            volume.planes.push_back({normal, random.uniform(-0.5, 1.5)});
        }
        Box box;
        box.add(pointInOrOut(random));
        box.add(pointInOrOut(random));
        const Containment answer = classify(volume, box);
        for (int sample = 0; sample < 20; ++sample) {
            const glm::dvec3 t(random.unit(), random.unit(), random.unit());
            const bool inside = contains(volume, glm::mix(box.min, box.max, t));
            EXPECT_FALSE(inside && answer == Containment::Outside);
            EXPECT_FALSE(!inside && answer == Containment::Inside);
        }
    }
}

/// How many of a box's corners a volume holds.
int cornersInside(const ConvexVolume& volume, const Box& box) {
    int inside = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(
            (corner & 1U) != 0 ? box.max.x : box.min.x,
            (corner & 2U) != 0 ? box.max.y : box.min.y,
            (corner & 4U) != 0 ? box.max.z : box.min.z);
        inside += contains(volume, p) ? 1 : 0;
    }
    return inside;
}

// For one plane the box's farthest and nearest corners decide, so that the answer is exact and not conservative only.
TEST(ConvexVolume, OnePlaneIsClassifiedExactly) {
    Random random(8);
    std::array<int, 3> seen{};
    for (int trial = 0; trial < 3000; ++trial) {
        const ConvexVolume volume{{{glm::normalize(pointInOrOut(random) + glm::dvec3(1e-9)), random.uniform(-2, 2)}}};
        Box box;
        box.add(pointInOrOut(random));
        box.add(pointInOrOut(random));
        const int inside = cornersInside(volume, box);
        const Containment expected = inside == 0   ? Containment::Outside
                                     : inside == 8 ? Containment::Inside
                                                   : Containment::Intersecting;
        EXPECT_EQ(classify(volume, box), expected);
        ++seen.at(static_cast<std::size_t>(expected));
    }
    for (const int count : seen)
        EXPECT_GT(count, 500);
}

TEST(ConvexVolume, NoPlanesAreAllOfSpaceAndATouchIsNotOutside) {
    EXPECT_TRUE(contains({}, {1e300, 0, 0}));
    EXPECT_EQ(classify({}, {{-1, -1, -1}, {1, 1, 1}}), Containment::Inside);
    const ConvexVolume above{{{{0, 0, 1}, -1}}}; // z >= 1
    EXPECT_TRUE(contains(above, {0, 0, 1}));
    EXPECT_FALSE(contains(above, {0, 0, 0.999}));
    EXPECT_EQ(classify(above, {{0, 0, 0}, {1, 1, 1}}), Containment::Intersecting) << "its upper face lies in the plane";
    EXPECT_EQ(classify(above, {{0, 0, 1}, {1, 1, 2}}), Containment::Intersecting) << "undecided: its lower face does";
    EXPECT_EQ(classify(above, {{0, 0, 1.001}, {1, 1, 2}}), Containment::Inside);
    EXPECT_EQ(above.planes[0].signedDistance({5, 5, 3}), 2);
}

__extension__ using Wide = __int128;

constexpr double kUnit = 0x1p-52;

/// A multiple of kUnit, below 1: integers of 53 bits stand for it exactly.
double inUnits(Random& random) {
    return std::round(random.uniform(-1, 1) / kUnit) * kUnit;
}

Wide units(double value) {
    return static_cast<std::int64_t>(value / kUnit);
}

/// The corner of `box` that lies furthest along `sign` times `normal`.
glm::dvec3 cornerAlong(const Box& box, const glm::dvec3& normal, double sign) {
    glm::dvec3 corner(0);
    for (int axis = 0; axis < 3; ++axis)
        corner[axis] = sign * normal[axis] > 0 ? box.max[axis] : box.min[axis];
    return corner;
}

/// dot(normal, p) in units of kUnit^2, exactly.
Wide exactDot(const glm::dvec3& normal, const glm::dvec3& p) {
    return units(normal.x) * units(p.x) + units(normal.y) * units(p.y) + units(normal.z) * units(p.z);
}

// A plane is put to the next unit from where it touches a corner: by integers its side is known, by floats it is not.
TEST(ConvexVolume, NoRoundingLosesABoxThatTouchesOrHoldsOneThatDoesNot) {
    Random random(9);
    constexpr std::int64_t kSquare = std::int64_t{1} << 52U;
    for (int trial = 0; trial < 20000; ++trial) {
        const glm::dvec3 direction = glm::normalize(pointInOrOut(random) + glm::dvec3(1e-9));
        const glm::dvec3 normal = glm::round(direction / kUnit) * kUnit;
        Box box;
        box.add({inUnits(random), inUnits(random), inUnits(random)});
        box.add({inUnits(random), inUnits(random), inUnits(random)});
        const auto offsetOver = [&](const glm::dvec3& corner) { // the least with the corner on the inner side
            const Wide dot = exactDot(normal, corner);
            Wide offset = -dot / kSquare;
            while (dot + offset * kSquare < 0)
                ++offset;
            while (dot + (offset - 1) * kSquare >= 0)
                --offset;
            return static_cast<double>(static_cast<std::int64_t>(offset)) * kUnit;
        };
        const double touching = offsetOver(cornerAlong(box, normal, 1));
        const double sticksOut = offsetOver(cornerAlong(box, normal, -1)) - kUnit;
        for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            const tests::RoundingMode rounding(mode);
            const Containment touches = classify({{{normal, touching}}}, box);
            const Containment isCut = classify({{{normal, sticksOut}}}, box);
            EXPECT_NE(touches, Containment::Outside) << "trial " << trial << ", rounding " << mode;
            EXPECT_NE(isCut, Containment::Inside) << "trial " << trial << ", rounding " << mode;
        }
    }
}

} // namespace
} // namespace gnomon
