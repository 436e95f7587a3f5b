// What the rule charges a caster, against marching along its ray of light; no less and no more.
#include "tests/support/model_views.h"
#include "tests/support/random_point.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::lod {
namespace {

const Box kSpace{{-10, -3, -10}, {10, 5, 10}};

/// The least view depth of a receiver on the ray of light through `point`, by small steps; infinite if there is none.
double minReceiverDepth(const CasterDetail& caster, const DetailView& view, const glm::dvec3& point, double step) {
    double min = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 receiver = point - caster.towardsLight * (step * i);
        if (contains(caster.receivers, receiver)) min = std::min(min, glm::dot(receiver - view.eye, view.basis.view));
    }
    return min;
}

// A point has one ray of light, so the charge is the error over the least depth where that ray meets the receivers.
TEST(CasterRule, ChargesAPointWhatItsRayOfLightMeets) {
    Random random(24);
    int charged = 0;
    int free = 0;
    for (int trial = 0; trial < 9000; ++trial) {
        const DetailView view = tests::randomView(random, kSpace);
        std::vector<CasterDetail> casters = tests::randomCasters(random, view);
        casters.resize(1);
        const CasterDetail& caster = casters[0];
        const ErrorRule rule(view, casters);
        const glm::dvec3 point = view.eye + randomPoint(random, 20);
        const double error = std::exp(random.uniform(-6, 0));
        const double reported = rule.casterPixels({point, 0}, error);
        const double step = caster.receiverNear * 0.01;
        const double min = minReceiverDepth(caster, view, point, step);
        const double zeta = glm::dot(caster.texel.axis, point) - caster.texel.origin;
        const bool isSeen =
            std::isfinite(min) && contains(caster.casters, point) && error > 0.5 * caster.texel.smallerSide(zeta);
        if (isSeen) {
            ++charged;
            const double expected = error * view.edgePixelsPerUnit() / std::max(min, caster.receiverNear);
            EXPECT_GE(reported, expected * (1 - 1e-9));
            EXPECT_LE(reported, expected * (1 + 2 * step / caster.receiverNear)) << "as exact as the steps are";
        } else {
            free += reported == 0 ? 1 : 0;
        }
        EXPECT_LE(reported, error * view.edgePixelsPerUnit() / caster.receiverNear * (1 + 1e-9));
    }
    EXPECT_GT(charged, 100);
    EXPECT_GT(free, 1000);
}

/// A view along -z with a square image, and one partition lit from straight above: everything by hand.
struct ByHand {
    ByHand() {
        view.basis = cameraBasis(Camera{});
        view.tanHalfX = view.tanHalfY = 1;
        view.heightPixels = 200; // 100 pixels a unit at depth 1, 120 of an edge
        caster.receivers = viewPyramid(view);
        caster.receivers.planes.push_back({{0, 0, -1}, -2}); // from depth 2 ...
        caster.receivers.planes.push_back({{0, 0, 1}, 8});   // ... to depth 8
        caster.receiverNear = 2;
        caster.texel.axis = {0, 0, -1};
        caster.texel.depth = 8;
        caster.texel.width = 0.1;
        caster.texel.length = 0.1;
    }

    double pixels(const Sphere& bounds, double error) const {
        return ErrorRule(view, {caster}).casterPixels(bounds, error);
    }

    DetailView view;
    CasterDetail caster;
};

TEST(CasterRule, StraightFromAboveIsTheErrorOverTheDepthBelow) {
    const ByHand scene;
    EXPECT_NEAR(scene.pixels({{0, 100, -5}, 0}, 0.3), 0.3 * 120 / 5, 1e-9);
    EXPECT_NEAR(scene.pixels({{0, 100, -5}, 1}, 0.3), 0.3 * 120 / 4, 1e-9) << "its nearest point";
    EXPECT_NEAR(scene.pixels({{0, 100, -2.5}, 1}, 0.3), 0.3 * 120 / 2, 1e-9) << "no nearer than the receivers";
    EXPECT_EQ(scene.pixels({{0, -100, -5}, 1}, 0.3), 0) << "below, it shadows nothing";
    EXPECT_EQ(scene.pixels({{0, 100, -1}, 0.5}, 0.3), 0) << "in front of the receivers";
    EXPECT_EQ(scene.pixels({{0, 100, -9}, 0.5}, 0.3), 0) << "behind them";
    EXPECT_EQ(scene.pixels({{0, 100, -5}, 1}, 0), 0);
    EXPECT_NEAR(scene.pixels({{0, 0, -5}, 0}, 0.3), 0.3 * 120 / 5, 1e-9) << "in view as out of it";
}

TEST(CasterRule, ACasterInViewIsChargedWhereItsShadowFallsNearTheEye) {
    ByHand scene; // the sun is beyond what is looked at
    scene.caster.towardsLight = glm::normalize(glm::dvec3(0, 1, -1));
    const Sphere farAway{{0, 3, -7}, 0};
    const double seen = ErrorRule(scene.view).pixels(farAway, 0.3);
    EXPECT_LT(seen, 0.3 * 100 / 6);
    EXPECT_NEAR(scene.pixels(farAway, 0.3), 0.3 * 120 / 2, 1e-9) << "its ray of light reaches depth 2 in view";
    scene.caster.receivers.planes.push_back({{0, 1, 0}, -1}); // the model ends at y = 1, where the ray is at depth 5
    EXPECT_NEAR(scene.pixels(farAway, 0.3), 0.3 * 120 / 5, 1e-9) << "nothing is shadowed beyond the model";
}

TEST(CasterRule, HalfATexelIsForFree) {
    const ByHand scene;
    EXPECT_EQ(scene.pixels({{0, 100, -5}, 0}, 0.05), 0);
    EXPECT_GT(scene.pixels({{0, 100, -5}, 0}, 0.0501), 0);
    ByHand warped;
    warped.caster.texel.kappa = 0.5; // at zeta 5: across 0.1 * 3.5, along 0.1 * 3.5^2 / 5
    EXPECT_EQ(warped.pixels({{0, 100, -5}, 0}, 0.5 * 0.1 * 3.5 * 3.5 / 5), 0);
    EXPECT_GT(warped.pixels({{0, 100, -5}, 0}, 0.5 * 0.1 * 3.5 * 3.5 / 5 * 1.001), 0);
    EXPECT_GT(warped.pixels({{0, 100, -5}, 1}, 0.5 * 0.1 * 3.5 * 3.5 / 5), 0) << "its near side has smaller texels";
}

TEST(CasterRule, APartitionThatTheCasterDoesNotReachCostsNothing) {
    ByHand scene;
    scene.caster.casters.planes.push_back({{0, 1, 0}, -50}); // only what is higher than 50
    EXPECT_GT(scene.pixels({{0, 100, -5}, 1}, 0.3), 0);
    EXPECT_EQ(scene.pixels({{0, 40, -5}, 1}, 0.3), 0);
    EXPECT_GT(scene.pixels({{0, 49.5, -5}, 1}, 0.3), 0) << "it touches";
}

TEST(CasterRule, TheWorstPartitionCounts) {
    const ByHand scene;
    CasterDetail nearer = scene.caster;
    nearer.receivers = viewPyramid(scene.view);
    nearer.receiverNear = 0.5;
    const Sphere above{{0, 100, -5}, 0};
    CasterDetail coarse = scene.caster;
    coarse.texel.width = coarse.texel.length = 9;
    for (const std::vector<CasterDetail>& casters :
         {std::vector{scene.caster, coarse},
          std::vector{coarse, scene.caster},
          std::vector{coarse, nearer, scene.caster}})
        EXPECT_NEAR(ErrorRule(scene.view, casters).casterPixels(above, 0.3), 0.3 * 120 / 5, 1e-9);
    EXPECT_EQ(ErrorRule(scene.view, {coarse}).casterPixels(above, 0.3), 0);
    EXPECT_EQ(ErrorRule(scene.view).casterPixels(above, 0.3), 0) << "rays, or no shadows";
}

TEST(CasterRule, AFloorSavesWorkAndChangesNoDecision) {
    Random random(25);
    int above = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const DetailView view = tests::randomView(random, kSpace);
        const ErrorRule rule(view, tests::randomCasters(random, view));
        const Sphere sphere{view.eye + randomPoint(random, 20), random.uniform(0, 3)};
        const double error = std::exp(random.uniform(-6, 0));
        const double threshold = std::exp(random.uniform(-3, 4));
        const double exact = rule.casterPixels(sphere, error);
        EXPECT_EQ(rule.casterPixels(sphere, error, threshold) > threshold, exact > threshold);
        EXPECT_EQ(rule.exceeds(sphere, error, threshold), rule.pixels(sphere, error) > threshold);
        above += exact > threshold ? 1 : 0;
    }
    EXPECT_GT(above, 500);
}

TEST(TexelWidth, IsTheSmallerOfBothSidesAndClampedToTheMap) {
    TexelWidth texel;
    texel.depth = 4;
    texel.kappa = 0.5;
    texel.width = 1;
    texel.length = 0.5;
    for (const double zeta : {0.0, 0.5, 1.0, 2.0, 3.5, 4.0}) {
        const double across = 1 + 0.5 * zeta;
        const double along = 0.5 * across * across / 3;
        EXPECT_NEAR(texel.smallerSide(zeta), std::min(across, along), 1e-15) << zeta;
    }
    EXPECT_EQ(texel.smallerSide(-7), texel.smallerSide(0));
    EXPECT_EQ(texel.smallerSide(70), texel.smallerSide(4));
    texel.width = 0.01;
    EXPECT_NEAR(texel.smallerSide(4), 0.03, 1e-15);
    EXPECT_EQ(TexelWidth{}.smallerSide(1), 0) << "rays have no texels";
}

TEST(ViewPyramid, HoldsWhatTheImageShows) {
    Random random(26);
    int shown = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const DetailView view = tests::randomView(random, kSpace);
        const glm::dvec3 point = view.eye + randomPoint(random, 9);
        const glm::dvec3 p = toCamera(view.basis, point - view.eye);
        const bool isShown = p.z >= 0 && std::abs(p.x) <= view.tanHalfX * p.z && std::abs(p.y) <= view.tanHalfY * p.z;
        EXPECT_EQ(contains(viewPyramid(view), point), isShown);
        for (const Plane& plane : viewPyramid(view).planes)
            EXPECT_NEAR(glm::length(plane.normal), 1, 1e-12);
        shown += isShown ? 1 : 0;
    }
    EXPECT_GT(shown, 1000);
}

} // namespace
} // namespace gnomon::lod
