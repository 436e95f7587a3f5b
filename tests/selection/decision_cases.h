// Decisions of the error rule that are made anew where rounding is another, for the tests and the program by chance.
#pragma once

#include "model_views.h"
#include "selection/decision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace gnomon::tests {

struct DecisionCounts {
    std::uint64_t decisions = 0;
    std::uint64_t undecided = 0;
    std::uint64_t changed = 0; // by rounding; all undecided
};

/// A view, its casters, and bounds that lie anywhere or touch a plane of the view or of a caster but for a rounding.
struct DecisionCase {
    explicit DecisionCase(Random& random)
        : view(randomView(random, {{-10, -3, -10}, {10, 5, 10}})), casters(randomCasters(random, view)) {
        for (selection::CasterDetail& caster : casters) {
            if (random.below(4) == 0)
                caster.point = {view.eye + randomPoint(random, 9), std::exp(random.uniform(0, 4))};
            if (random.below(4) == 0) alongPlane(random, caster);
        }
        error = std::exp(random.uniform(-8, 0));
        bounds = {view.eye + randomPoint(random, 20), std::exp(random.uniform(-5, 2))};
        if (random.below(3) == 0) touchPlane(random);
        if (random.below(8) == 0) bounds.center = view.eye + view.basis.view * random.uniform(0, 20); // on the axis
        if (random.below(4) == 0) error = halfATexel(casters.back()); // which is for free
    }

    static glm::dvec3 randomPoint(Random& random, double reach) {
        return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
    }

    /// Has light fall along a plane of the receivers, or a rounding beside it.
    static void alongPlane(Random& random, selection::CasterDetail& caster) {
        const glm::dvec3& normal = caster.receivers.planes[random.below(caster.receivers.planes.size())].normal;
        caster.towardsLight = glm::normalize(glm::cross(normal, randomPoint(random, 1) + glm::dvec3(1e-9)));
    }

    double halfATexel(const selection::CasterDetail& caster) const {
        const double zeta = glm::dot(caster.texel.axis, bounds.center) - caster.texel.origin;
        return 0.5 * caster.texel.smallerSide(zeta - bounds.radius);
    }

    void touchPlane(Random& random) {
        const ConvexVolume pyramid = selection::viewPyramid(view);
        const std::vector<Plane>& planes = random.below(2) == 0 ? pyramid.planes : casters[0].receivers.planes;
        const Plane& plane = planes[random.below(planes.size())];
        bounds.radius = std::abs(plane.signedDistance(bounds.center));
    }

    selection::DetailView view;
    std::vector<selection::CasterDetail> casters;
    Sphere bounds;
    double error = 0;
};

/// The rule of `of`, made and asked for what it gives and for what it decides; in another function, so that no compiler
/// moves it out of where rounding is set.
struct DecidedPixels {
    double pixels = 0;
    bool exceeds = false;
};

[[gnu::noinline]] inline DecidedPixels decided(const DecisionCase& of, double threshold) {
    const selection::ErrorRule rule(of.view, of.casters);
    return {rule.pixels(of.bounds, of.error), rule.exceeds(of.bounds, of.error, threshold)};
}

/// Holds what `Rounding(with)` makes of random cases to what is certain; thresholds are what the rule gives, a few
/// units beside it, or anything.
template <class Rounding, class With>
void expectSameDecisions(Random& random, With with, DecisionCounts& counts) {
    const DecisionCase one(random);
    const selection::ErrorRule rule(one.view, one.casters);
    const selection::CertainRule certain(rule);
    const double usual = rule.pixels(one.bounds, one.error);
    const selection::Range range = certain.pixels(one.bounds, one.error);
    const std::uint64_t kind = random.below(3);
    const double threshold = kind == 0   ? std::exp(random.uniform(-5, 3))
                             : kind == 1 ? usual
                                         : usual * (1 + random.uniform(-4, 4) * 0x1p-52);
    const selection::Decision decision = certain.exceeds(one.bounds, one.error, threshold);
    DecidedPixels other;
    {
        const Rounding rounding(with);
        other = decided(one, threshold);
    }
    const bool usually = rule.exceeds(one.bounds, one.error, threshold);
    ++counts.decisions;
    counts.undecided += decision == selection::Decision::Undecided ? 1 : 0;
    counts.changed += usually != other.exceeds ? 1 : 0;
    for (const double pixels : {usual, other.pixels}) {
        EXPECT_GE(pixels, range.low);
        EXPECT_LE(pixels, range.high);
    }
    if (decision == selection::Decision::Undecided) return;
    EXPECT_EQ(usually, decision == selection::Decision::Yes);
    EXPECT_EQ(other.exceeds, decision == selection::Decision::Yes);
}

} // namespace gnomon::tests
