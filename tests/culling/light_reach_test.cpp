// What bounds penumbrae and what may hide the sky, against loops over all pairs.
#include "culling/open_sky.h"
#include "culling/penumbra_width.h"
#include "seen_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::culling {
namespace {

std::array<glm::dvec3, 8> boxCornersOf(const Box& box) {
    std::array<glm::dvec3, 8> corners{};
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            corners[i][axis] = (i >> static_cast<unsigned>(axis) & 1U) != 0 ? box.max[axis] : box.min[axis];
    return corners;
}

/// From where to where corners reach along an axis.
struct AxisReach {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};

AxisReach reachAlong(const Box& box, const glm::dvec3& axis) {
    AxisReach reach;
    for (const glm::dvec3& corner : boxCornersOf(box)) {
        reach.low = std::min(reach.low, glm::dot(axis, corner));
        reach.high = std::max(reach.high, glm::dot(axis, corner));
    }
    return reach;
}

std::vector<Box> drawnBoxes(const selection::CutQuery& query, const selection::DrawList& list) {
    std::vector<Box> boxes;
    forEveryCluster(query, list, [&](const hierarchy::Page&, const hierarchy::Cluster& cluster) {
        boxes.push_back(query.trees->grid().local(cluster.box));
    });
    return boxes;
}

TEST(WidestPenumbra, IsThatOfTheFarthestPairThatShareABeam) {
    Random random(31);
    int apart = 0;
    for (int round = 0; round < 4; ++round) {
        const Seen seen(random);
        const selection::CutQuery query = seen.query();
        const DiscLight light{
            glm::normalize(glm::dvec3(random.uniform(-1, 1), random.uniform(0.1, 1), random.uniform(-1, 1))),
            random.uniform(0.005, 0.2)};
        const double nearest = random.uniform(0.5, 2);
        const std::vector<Box> boxes = drawnBoxes(query, seen.cut.lists[0]);
        // Any two directions across the light do, since an overlap in all of them is asked of boxes: those of its own.
        glm::dvec3 other(0);
        other[std::abs(light.towards.x) < 0.5 ? 0 : 1] = 1;
        const glm::dvec3 right = glm::normalize(glm::cross(other, light.towards));
        const std::array axes = {right, glm::cross(light.towards, right)};
        const ConvexVolume pyramid = selection::viewPyramid(seen.view);
        double widest = 0;
        for (const Box& receiver : boxes) {
            if (classify(pyramid, receiver) == Containment::Outside) continue;
            const double depth = std::max(
                reachAlong(receiver, seen.view.basis.view).low - glm::dot(seen.view.basis.view, seen.view.eye),
                nearest);
            const double pixel = 2 * seen.view.tanHalfY / seen.view.heightPixels * depth;
            const double aslant =
                std::sqrt(1 + seen.view.tanHalfX * seen.view.tanHalfX + seen.view.tanHalfY * seen.view.tanHalfY);
            for (const Box& caster : boxes) {
                const double before = reachAlong(caster, light.towards).high - reachAlong(receiver, light.towards).low;
                const bool shareABeam = std::all_of(axes.begin(), axes.end(), [&](const glm::dvec3& axis) {
                    const AxisReach a = reachAlong(caster, axis);
                    const AxisReach b = reachAlong(receiver, axis);
                    const double spread = 0.5 * light.slope * before;
                    return a.high >= b.low - spread && a.low <= b.high + spread;
                });
                if (shareABeam) widest = std::max(widest, light.slope * before * aslant / pixel);
            }
        }
        const double found = widestPenumbra(query, seen.cut.lists[0], {}, light, nearest);
        EXPECT_NEAR(found, widest, 1e-9 * widest);
        apart += widest > 0 ? 1 : 0;
        const double twice = widestPenumbra(query, seen.cut.lists[0], std::span(&seen.cut.lists[0], 1), light, nearest);
        EXPECT_EQ(twice, found) << "a caster that is seen, too, is one";
    }
    EXPECT_GT(apart, 1);
}

TEST(MayHideSky, IsSureOnlyWhereNothingLiesBeforeAnyTriangle) {
    Random random(32);
    int hidden = 0;
    for (int round = 0; round < 8; ++round) {
        const Seen seen(random);
        const selection::CutQuery query = seen.query();
        const Box& bounds = tests::sharedModel().bounds;
        bool isHidden = false;
        forEveryTriangle(query, seen.cut.lists[0], [&](const auto& corners, const auto&, const auto&) {
            glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            if (glm::length(normal) == 0) return;
            if (glm::dot(normal, seen.view.eye - corners[0]) < 0) normal = -normal;
            for (const glm::dvec3& corner : boxCornersOf(bounds))
                isHidden |=
                    glm::dot(normal, corner - corners[0]) > glm::length(normal) * 2 * query.trees->grid().step();
        });
        // Where the box of all that there is lies behind every triangle nothing is hidden; a wavy ground may hide some.
        if (!isHidden) {
            EXPECT_FALSE(mayHideSky(query, seen.cut.lists[0], bounds));
        }
        if (mayHideSky(query, seen.cut.lists[0], bounds)) ++hidden;
    }
    EXPECT_GT(hidden, 0);
}

} // namespace
} // namespace gnomon::culling
