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

/// The widest penumbra of all pairs of `boxes`, one by one.
double widestOfPairs(const Seen& seen, const std::vector<Box>& boxes, const DiscLight& light, double nearest) {
    // Two directions across the light, the same as those whose overlap is asked for.
    glm::dvec3 other(0);
    other[std::abs(light.towards.x) < 0.5 ? 0 : 1] = 1;
    const glm::dvec3 right = glm::normalize(glm::cross(other, light.towards));
    const std::array axes = {right, glm::cross(light.towards, right)};
    const auto shareABeam = [&](const Box& caster, const Box& receiver, double before) {
        return std::all_of(axes.begin(), axes.end(), [&](const glm::dvec3& axis) {
            const AxisReach a = reachAlong(caster, axis);
            const AxisReach b = reachAlong(receiver, axis);
            const double spread = 0.5 * light.slope * before;
            return a.high >= b.low - spread && a.low <= b.high + spread;
        });
    };
    const selection::DetailView& view = seen.view;
    const double aslant = std::sqrt(1 + view.tanHalfX * view.tanHalfX + view.tanHalfY * view.tanHalfY);
    const ConvexVolume pyramid = selection::viewPyramid(view);
    double widest = 0;
    for (const Box& receiver : boxes) {
        if (classify(pyramid, receiver) == Containment::Outside) continue;
        const double least = reachAlong(receiver, view.basis.view).low - glm::dot(view.basis.view, view.eye);
        const double pixel = 2 * view.tanHalfY / view.heightPixels * std::max(least, nearest);
        for (const Box& caster : boxes) {
            const double before = reachAlong(caster, light.towards).high - reachAlong(receiver, light.towards).low;
            const double width = light.slope * before * aslant / pixel;
            if (width > widest && shareABeam(caster, receiver, before)) widest = width;
        }
    }
    return widest;
}

TEST(WidestPenumbra, IsThatOfTheFarthestPairThatShareABeam) {
    Random random(31);
    int found = 0;
    for (int round = 0; round < 8; ++round) {
        const Seen seen(random);
        const selection::CutQuery query = seen.query();
        const DiscLight light{
            glm::normalize(glm::dvec3(random.uniform(-1, 1), random.uniform(0.1, 1), random.uniform(-1, 1))),
            random.uniform(0.005, 0.2)};
        const double nearest = random.uniform(0.5, 2);
        const selection::DrawList& image = seen.cut.lists[0];
        const double wanted = widestOfPairs(seen, drawnBoxes(query, image), light, nearest);
        const double widest = widestPenumbra(query, image, {}, light, nearest);
        EXPECT_NEAR(widest, wanted, 1e-9 * wanted);
        EXPECT_EQ(widestPenumbra(query, image, std::span(&image, 1), light, nearest), widest)
            << "a caster that is seen, too, is one";
        found += wanted > 0 ? 1 : 0;
    }
    EXPECT_GT(found, 3);
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
            EXPECT_FALSE(mayHideSky(query, seen.cut.lists[0], bounds, Solids::Whole));
        }
        if (mayHideSky(query, seen.cut.lists[0], bounds, Solids::Whole)) ++hidden;
    }
    EXPECT_GT(hidden, 0);
}

} // namespace
} // namespace gnomon::culling
