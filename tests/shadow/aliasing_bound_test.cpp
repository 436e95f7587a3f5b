// The promise: the largest aliasing lies at the vertices, and what a setup promises holds at every point of its maps.
#include "measured_map.h"
#include "shadow/setup.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

/// A random convex combination of the region's vertices, biased towards its corners and edges.
glm::dvec3 randomPointOf(Random& random, const Region& region) {
    glm::dvec3 sum(0);
    double total = 0;
    const double sharpness = random.below(2) == 0 ? 1 : 12;
    for (const FitVertex& vertex : region.vertices) {
        const double weight = std::pow(random.unit(), sharpness);
        sum += vertex.position * weight;
        total += weight;
    }
    return sum / total;
}

enum class Warps : std::uint8_t { Any, Logarithmic };

void checkSeed(std::uint64_t seed, int points, Warps warps = Warps::Any) {
    Random random(seed);
    const ShadowView view = randomView(random);
    ShadowOptions options = randomOptions(random, view.frustum);
    options.filterTexels = 0;
    if (warps == Warps::Logarithmic) {
        options.scheme.warp.rule = WarpRule::Log;
        options.stabilized = false;
    }
    const ShadowMapSetup setup = shadowMapSetup(view, options);
    const ShadowMap& map = setup.maps[random.below(setup.maps.size())];
    if (map.warped.kappa * map.warped.length > 1e4) return; // differences next to the warp's centre have no digits left
    Measured worst;
    const auto include = [&](const glm::dvec3& p) {
        const Measured m = measuredAt(map, view, p);
        worst = {std::max(worst.x, m.x), std::max(worst.z, m.z), std::max(worst.sheared, m.sheared)};
    };
    for (int i = 0; i < points; ++i)
        include(randomPointOf(random, map.region));
    const double slack = 1e-5; // of the differences
    ASSERT_LE(worst.x, map.aliasingBound.x * (1 + slack)) << "seed " << seed;
    ASSERT_LE(worst.z, map.aliasingBound.z * (1 + slack)) << "seed " << seed;
    ASSERT_LE(worst.sheared, map.aliasingBound.sheared * (1 + slack)) << "seed " << seed;
    // Near the vertices the samples come up to the promise.
    for (const FitVertex& vertex : map.region.vertices)
        include(vertex.position * (1 - 1e-9) + randomPointOf(random, map.region) * 1e-9);
    ASSERT_GE(worst.x, map.aliasingBound.x * 0.99) << "seed " << seed << " " << name(map.region.face);
    // What sizes logarithmic rows is the sheared texel.
    const bool isLog = options.scheme.warp.rule == WarpRule::Log && !options.stabilized;
    const double sized = isLog ? worst.sheared : worst.z;
    ASSERT_GE(sized, map.aliasingBound.z * 0.99) << "seed " << seed << " " << name(map.region.face);
    // Where a texel leans by more than sqrt(2) to one, the sheared promise is a product of two maxima.
    const double kappa = map.warped.kappa;
    const double lean = kappa * std::max(std::abs(map.warped.uMin), std::abs(map.warped.uMin + map.warped.width));
    const double overshoot = !isLog && lean > std::sqrt(2.0) ? std::sqrt(1 + lean * lean) : 1;
    ASSERT_GE(worst.sheared * overshoot, map.aliasingBound.sheared * 0.99) << "seed " << seed;
}

TEST(AliasingBound, NoSampleIsAboveItAndTheLargestComesUpToIt) {
    for (std::uint64_t seed = 0; seed < 2000 && !HasFatalFailure(); ++seed)
        checkSeed(seed, 100);
}

TEST(SlowAliasingBound, NoSampleIsAboveItAndTheLargestComesUpToIt) {
    for (std::uint64_t seed = 0; seed < 2000 && !HasFatalFailure(); ++seed)
        checkSeed(seed, 1000);
}

TEST(AliasingBound, HoldsForLogarithmicRowsShearedTexelsIncluded) {
    for (std::uint64_t seed = 0; seed < 1000 && !HasFatalFailure(); ++seed)
        checkSeed(seed, 100, Warps::Logarithmic);
}

/// A million points of a thousand plans.
TEST(SlowAliasingBound, HoldsForLogarithmicRowsShearedTexelsIncluded) {
    for (std::uint64_t seed = 5000; seed < 6000 && !HasFatalFailure(); ++seed)
        checkSeed(seed, 1000, Warps::Logarithmic);
}

TEST(AliasingBound, AFacesRegionHasTheErrorOfItsFourCorners) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        ShadowView view = randomView(random);
        view.towardsLight = randomDirection(random);
        ShadowOptions options = randomOptions(random, view.frustum);
        options.stabilized = false;
        options.scheme.faces = true;
        options.scheme.nearFace = NearFace::OwnMap;
        options.scheme.warp.rule = WarpRule::Minimax;
        const PartitionSelector selector = partitionSelector(
            view.frustum, view.towardsLight, {view.frustum.near, view.frustum.far}, FaceMaps::SidesAndNear);
        const std::size_t exact = sideFaces(view.frustum, view.towardsLight).size();
        if (!selector.ownNear || selector.faces.size() != exact) continue; // a sliver was merged
        for (std::size_t i = 0; i < selector.faces.size(); ++i) {
            const Region region = partitionRegion(view.frustum, selector, i);
            const LightFit corners = fitFace(view.frustum, view.towardsLight, region.face, options.scheme.bisector);
            const LightFit whole = fitRegion(corners.frame, view.frustum, region.vertices);
            const double kappa = kappaMinimax(corners);
            EXPECT_NEAR(worstAliasing(whole, kappa).x / worstAliasing(corners, kappa).x, 1, 1e-6) << "seed " << seed;
            EXPECT_NEAR(worstAliasing(whole, kappa).z / worstAliasing(corners, kappa).z, 1, 1e-6) << "seed " << seed;
        }
    }
}

TEST(AliasingBound, HoldsOverTheFrustumWhateverIsShownBeyondIt) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        ShadowView view = randomView(random);
        ShadowOptions options = randomOptions(random, view.frustum);
        options.filterTexels = 0;
        view.shown = shownOutside(random, view.frustum);
        const ShadowMapSetup setup = shadowMapSetup(view, options);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 p = randomPointIn(random, view.frustum);
            const ShadowMap& map = setup.maps.at(setup.mapOf(p));
            if (map.warped.kappa * map.warped.length > 1e4) continue;
            const Measured found = measuredAt(map, view, p);
            const double slack = 1 + 1e-5; // of the differences
            ASSERT_LE(found.x, map.aliasingBound.x * slack) << "seed " << seed;
            ASSERT_LE(found.z, map.aliasingBound.z * slack) << "seed " << seed;
            ASSERT_LE(found.sheared, map.aliasingBound.sheared * slack) << "seed " << seed;
        }
    }
}

TEST(AliasingBound, AFilterWidensTheTexel) {
    const ShadowView view;
    ShadowOptions options;
    const double plain = shadowMapSetup(view, options).worst().worst();
    options.filterTexels = 3;
    const double filtered = shadowMapSetup(view, options).worst().worst();
    EXPECT_GT(filtered, 3 * plain);
    EXPECT_LT(filtered, 3.1 * plain);
}

TEST(AliasingBound, FiguresOfTheTheory) {
    // theory: 800x800 pixels, 2048x2048 texels, alpha 1000, theta 20 degrees, k = 4; worst and median over all lights.
    ShadowView view;
    view.frustum = {1, 1000, 20 * kPi / 180, 1};
    ShadowOptions options;
    options.chosenOrientation = false;
    options.scheme.warp.rule = WarpRule::Minimax;
    std::vector<double> bounds;
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
        view.towardsLight = randomDirection(random);
        bounds.push_back(shadowMapSetup(view, options).worst().worst());
    }
    std::sort(bounds.begin(), bounds.end());
    EXPECT_NEAR(bounds[1000], 2.8, 0.15);
    EXPECT_NEAR(bounds.back(), 6.2, 0.15);
}

// What Eqs 22 and 23 say of large ratios is the growth of the closed forms: squaring the ratio multiplies both alike.
TEST(Storage, GrowsWithLargeDepthRatiosAsTheClosedFormsDo) {
    const ViewFrustum large{1, 1e24, 0.5, 1};
    const ViewFrustum larger{1, 1e48, 0.5, 1};
    for (const int maps : {4, 8, 12}) {
        const double slices = closedForms(larger, maps).zpOverhead / closedForms(large, maps).zpOverhead;
        EXPECT_NEAR(slices / largeRatioForms(1e24, maps).zpOverhead, 1, 0.02);
        const double faces =
            closedForms(larger, maps / 4).facesBehindPaper / closedForms(large, maps / 4).facesBehindPaper;
        EXPECT_NEAR(faces / largeRatioForms(1e24, maps).facesBehind, 1, 0.02);
    }
}

} // namespace
} // namespace gnomon::shadow
