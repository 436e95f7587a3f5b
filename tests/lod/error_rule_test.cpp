// The rule is monotone under nesting and reports no less than what a displaced point moves on the screen.
#include "exact_rule.h"
#include "tests/support/model_views.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::lod {
namespace {

using tests::randomCasters;
using tests::randomView;

const Box kErrorSpace{{-10, -3, -10}, {10, 5, 10}};

glm::dvec3 randomPointIn(Random& random, const Sphere& sphere) {
    while (true) {
        const glm::dvec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        if (glm::length(p) <= 1) return sphere.center + sphere.radius * p;
    }
}

Sphere randomSphere(Random& random) {
    const glm::dvec3 center(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20));
    return {center, std::exp(random.uniform(-5, 2))};
}

glm::dvec2 projected(const DetailView& view, const glm::dvec3& point) {
    const glm::dvec3 p = toCamera(view.basis, point - view.eye);
    return glm::dvec2(p.x, p.y) / p.z * view.pixelsPerUnit();
}

TEST(ErrorRule, EqualsTheRuleAt200Bits) {
    Random random(72);
    int positive = 0;
    for (int trial = 0; trial < 5000; ++trial) {
        const DetailView view = randomView(random, kErrorSpace);
        std::vector<CasterDetail> casters = randomCasters(random, view);
        for (CasterDetail& caster : casters)
            if (random.below(4) == 0) caster.point = {randomSphere(random).center, std::exp(random.uniform(0, 4))};
        const ErrorRule rule(view, casters);
        const Sphere bounds = randomSphere(random);
        const double error = std::exp(random.uniform(-8, 0));
        const double exact = tests::exactPixels(rule, bounds, error).rounded();
        EXPECT_NEAR(rule.pixels(bounds, error), exact, 1e-9 * exact) << trial;
        positive += exact > 0 ? 1 : 0;
    }
    EXPECT_GT(positive, 1000);
}

TEST(ErrorRule, NestedSpheresNeverGetMorePixels) {
    Random random(21);
    int positive = 0;
    for (int trial = 0; trial < 100000; ++trial) {
        const DetailView view = randomView(random, kErrorSpace);
        std::vector<CasterDetail> casters = randomCasters(random, view);
        for (CasterDetail& caster : casters)
            if (random.below(3) == 0) caster.point = {randomSphere(random).center, std::exp(random.uniform(0, 4))};
        const ErrorRule rule(view, std::move(casters));
        const Sphere outer = randomSphere(random);
        const double radius = outer.radius * random.unit();
        const Sphere inner{randomPointIn(random, {outer.center, outer.radius - radius}), radius * (1 - 1e-12)};
        const double outerError = std::exp(random.uniform(-8, 0));
        const double innerError = outerError * (random.below(2) == 0 ? 1 : random.unit());
        const double inside = rule.pixels(inner, innerError);
        positive += inside > 0 ? 1 : 0;
        EXPECT_LE(inside, rule.pixels(outer, outerError) * (1 + 1e-12));
        EXPECT_LE(rule.casterPixels(inner, innerError), rule.casterPixels(outer, outerError) * (1 + 1e-12));
    }
    EXPECT_GT(positive, 10000);
}

TEST(ErrorRule, WhatEnclosesSomethingOfABoxHasNoLessThanTheBoxPromises) {
    Random random(24);
    int aliasingBound = 0;
    double closest = 0;
    for (int trial = 0; trial < 100000; ++trial) {
        const ErrorRule rule(randomView(random, kErrorSpace));
        const Sphere middle = randomSphere(random);
        const Box box{middle.center - glm::dvec3(middle.radius), middle.center + glm::dvec3(middle.radius)};
        const double error = std::exp(random.uniform(-8, 0));
        const double minPixels = rule.minViewPixels(box, error);
        if (!(minPixels > 0)) continue;
        ++aliasingBound;
        const glm::dvec3 enclosed =
            box.min + box.extent() * glm::dvec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
        const double radius = std::exp(random.uniform(-9, 2));
        const Sphere sphere{randomPointIn(random, {enclosed, radius}), radius * (1 + 1e-12)};
        const double pixels = rule.viewPixels(sphere, error);
        EXPECT_GE(pixels, minPixels) << trial;
        closest = std::max(closest, minPixels / pixels);
    }
    EXPECT_GT(aliasingBound, 1000);
    EXPECT_GT(closest, 0.9) << "it promises too little";
}

TEST(ErrorRule, APointLightMagnifiesWhatIsNearIt) {
    DetailView view;
    view.basis = cameraBasis({view.eye, {0, 0, 1}, {0, 1, 0}, 1});
    CasterDetail caster; // anywhere; receivers 4 deep and more, up to 12 from the light
    caster.receiverNear = 4;
    caster.point = {{0, 3, 0}, 12};
    const ErrorRule rule(view, {caster});
    const double perUnit = view.edgePixelsPerUnit() / 4;
    EXPECT_DOUBLE_EQ(rule.casterPixels({{0, 0, 0}, 1}, 0.01), 0.01 * perUnit * 6) << "from 2 away";
    EXPECT_DOUBLE_EQ(rule.casterPixels({{0, -20, 0}, 1}, 0.01), 0.01 * perUnit) << "farther than what it could shadow";
    EXPECT_GT(rule.casterPixels({{0, 2.5, 0}, 1}, 0.01), 1e4 * 0.01 * perUnit) << "about the light";
}

TEST(ErrorRule, AShadowThatMeetsItsReceiversInOnePointIsSeen) {
    DetailView view;
    view.eye = {0, 0, 0};
    view.basis = cameraBasis({view.eye, {0, 0, 1}, {0, 1, 0}, 1});
    CasterDetail caster; // receivers are the plane z = 2, light falls along the view
    caster.receivers.planes = {{{0, 0, 1}, -2}, {{0, 0, -1}, 2}};
    caster.receiverNear = 1;
    caster.towardsLight = {0, 0, -1};
    const ErrorRule rule(view, {caster});
    EXPECT_EQ(rule.casterPixels({{0, 0, -4}, 0}, 1), view.edgePixelsPerUnit() / 2);
    EXPECT_EQ(rule.casterPixels({{0, 0, 4}, 0}, 1), 0) << "light goes the other way";
}

// The truth in view: points of the sphere that the image shows, moved by the error in every direction.
TEST(ErrorRule, NoPointInViewMovesFurtherThanReported) {
    Random random(22);
    int shown = 0;
    double tightest = 1e9;
    for (int trial = 0; trial < 200000; ++trial) {
        const DetailView view = randomView(random, kErrorSpace);
        const ErrorRule rule(view);
        const Sphere sphere = randomSphere(random);
        const glm::dvec3 point = randomPointIn(random, sphere);
        const glm::dvec3 inCamera = toCamera(view.basis, point - view.eye);
        const bool isShown = inCamera.z >= view.nearestDepth && std::abs(inCamera.x) <= view.tanHalfX * inCamera.z &&
                             std::abs(inCamera.y) <= view.tanHalfY * inCamera.z;
        if (!isShown) continue;
        ++shown;
        const double error = 1e-6 * inCamera.z; // small, so that the image of a displacement is linear
        const glm::dvec3 direction = randomPointIn(random, {glm::dvec3(0), 1});
        const glm::dvec3 moved = point + error * glm::normalize(direction + glm::dvec3(1e-9));
        const double seen = glm::distance(projected(view, point), projected(view, moved));
        const double reported = rule.pixels(sphere, error);
        EXPECT_LE(seen, reported * 1.0001);
        tightest = std::min(tightest, reported / seen);
    }
    EXPECT_GT(shown, 10000);
    EXPECT_LT(tightest, 1.1) << "a bound that nothing comes near says little";
}

// Displacements of any length, of points of a box that the image shows.
TEST(ErrorRule, NothingInABoxMovesFurtherThanTheBoxAllows) {
    Random random(25);
    int shown = 0;
    double tightest = 1e9;
    for (int trial = 0; trial < 200000; ++trial) {
        const DetailView view = randomView(random, kErrorSpace);
        const ErrorRule rule(view);
        const glm::dvec3 size =
            std::exp(random.uniform(-5, 2)) * glm::dvec3(random.unit(), random.unit(), random.unit());
        const glm::dvec3 min(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20));
        const Box box{min, min + size};
        const glm::dvec3 point = min + glm::dvec3(random.unit(), random.unit(), random.unit()) * size;
        const glm::dvec3 inCamera = toCamera(view.basis, point - view.eye);
        const bool isShown = inCamera.z >= view.nearestDepth && std::abs(inCamera.x) <= view.tanHalfX * inCamera.z &&
                             std::abs(inCamera.y) <= view.tanHalfY * inCamera.z;
        if (!isShown) continue;
        const double error = inCamera.z * std::exp(random.uniform(-12, 1));
        const glm::dvec3 direction = randomPointIn(random, {glm::dvec3(0), 1}) + glm::dvec3(1e-9);
        const glm::dvec3 moved = point + error * glm::normalize(direction);
        if (toCamera(view.basis, moved - view.eye).z < view.nearestDepth) continue;
        ++shown;
        const double across = view.heightPixels * std::hypot(1.0, view.tanHalfX / view.tanHalfY);
        const double seen = std::min(across, glm::distance(projected(view, point), projected(view, moved)));
        const double reported = rule.maxViewPixels(box, error);
        EXPECT_LE(seen, reported * (1 + 1e-9));
        EXPECT_LE(reported, across);
        if (error < 1e-3 * inCamera.z) tightest = std::min(tightest, reported / seen);
    }
    EXPECT_GT(shown, 10000);
    EXPECT_LT(tightest, 1.2) << "a bound that nothing comes near says little";
}

TEST(ErrorRule, ABoxOutOfViewShowsNothing) {
    DetailView view;
    view.basis = cameraBasis({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1});
    const ErrorRule rule(view);
    EXPECT_EQ(rule.maxViewPixels({{-1, -1, 5}, {1, 1, 7}}, 0.1), 0);
    EXPECT_EQ(rule.maxViewPixels({{-1, -1, -7}, {1, 1, -5}}, 0), 0);
    const double far = rule.maxViewPixels({{-1, -1, -70}, {1, 1, -50}}, 0.1);
    EXPECT_GT(far, 0);
    EXPECT_GT(rule.maxViewPixels({{-1, -1, -7}, {1, 1, -5}}, 0.1), 8 * far);
    EXPECT_LT(rule.maxViewPixels({{-1, -1, -7}, {1, 1, 5}}, 0.1), 1.5 * view.heightPixels) << "the eye is within";
}

TEST(ErrorRule, ChargesACornerMoreThanTheCentre) {
    DetailView view; // 60 degrees each way, looking along -z
    const ErrorRule rule(view);
    const double atCentre = rule.pixels({{0, 0, -10}, 1e-9}, 0.01);
    const double atCorner = rule.pixels({{5.7735, 5.7735, -10}, 1e-4}, 0.01);
    EXPECT_NEAR(atCentre, 0.01 / 10 * view.pixelsPerUnit(), 1e-6);
    EXPECT_NEAR(atCorner / atCentre, std::sqrt(1 + 2.0 / 3), 1e-3);
    EXPECT_EQ(rule.pixels({{0, 0, 10}, 1}, 0.01), 0) << "behind the eye";
    EXPECT_EQ(rule.pixels({{0, 0, -10}, 1}, 0), 0) << "nothing to gain";
    EXPECT_TRUE(std::isinf(rule.pixels({{0, 0, 10}, 1}, std::numeric_limits<double>::infinity())));
}

// The truth, in view or not: for points of the sphere, march along the ray of light and look for a receiver.
TEST(ErrorRule, NoShadowEdgeMovesFurtherThanReported) {
    Random random(23);
    int cast = 0;
    int inView = 0;
    for (int trial = 0; trial < 30000; ++trial) {
        const DetailView view = randomView(random, kErrorSpace);
        const std::vector<CasterDetail> casters = randomCasters(random, view);
        const ErrorRule rule(view, casters);
        const Sphere sphere = randomSphere(random);
        const glm::dvec3 point = randomPointIn(random, sphere);
        inView += contains(viewPyramid(view), point) ? 1 : 0;
        const double error = std::exp(random.uniform(-6, 0));
        for (const CasterDetail& caster : casters) {
            const double step = caster.receiverNear * 0.05;
            for (int i = 0; i < 400; ++i) {
                const glm::dvec3 receiver = point - caster.towardsLight * (step * i);
                if (!contains(caster.receivers, receiver)) continue;
                ++cast;
                const double depth = glm::dot(receiver - view.eye, view.basis.view);
                const double zeta = glm::dot(caster.texel.axis, receiver) - caster.texel.origin;
                const double edge = error * view.edgePixelsPerUnit() / depth;
                const bool isBelowTexel = error <= 0.5 * caster.texel.smallerSide(zeta);
                EXPECT_LE(isBelowTexel ? 0 : edge, rule.pixels(sphere, error) * (1 + 1e-9));
            }
        }
    }
    EXPECT_GT(cast, 1000);
    EXPECT_GT(inView, 500);
}

} // namespace
} // namespace gnomon::lod
