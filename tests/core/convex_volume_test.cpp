#include "core/convex_volume.h"
#include "core/random.h"

#include <gtest/gtest.h>

#include <array>

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
    EXPECT_EQ(classify(above, {{0, 0, 1}, {1, 1, 2}}), Containment::Inside) << "its lower face does";
    EXPECT_EQ(above.planes[0].signedDistance({5, 5, 3}), 2);
}

} // namespace
} // namespace gnomon
