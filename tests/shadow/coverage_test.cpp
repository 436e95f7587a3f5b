// Every point of the frustum lies in exactly one partition, and inside that partition's map with its kernel.
#include "measured_map.h"
#include "shadow/partition/region.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

/// How far outside of the partition's planes `p` is, in units of the slice's far depth.
double distanceOutside(const ShadowMap& map, const glm::dvec3& p) {
    double outside = 0;
    for (const Plane& plane : map.region.volume.planes)
        outside = std::max(outside, -plane.signedDistance(p) / map.region.covered.far);
    return outside;
}

/// The number of partitions, over all slices and faces, whose closed region `p` is well inside of.
int strictOwners(const ShadowMapSetup& setup, const glm::dvec3& p) {
    int owners = 0;
    for (const ShadowMap& map : setup.maps) {
        bool inside = true;
        for (const Plane& plane : map.region.volume.planes)
            inside = inside && plane.signedDistance(p) > 2e-3 * map.region.covered.far;
        owners += inside ? 1 : 0;
    }
    return owners;
}

void checkPoint(const ShadowMapSetup& setup, const ShadowOptions& options, const glm::dvec3& p) {
    const std::size_t index = setup.mapOf(p);
    ASSERT_LT(index, setup.maps.size());
    const ShadowMap& map = setup.maps[index];
    // The planes of merged slivers are 1e-3 off; everything else agrees to rounding.
    EXPECT_LE(distanceOutside(map, p), map.region.face == Face::Near ? 2e-3 : 1e-9)
        << name(map.region.face) << " of slice " << map.region.slice;
    EXPECT_LE(lookupOutside(map, options.filterTexels, p), 0)
        << name(map.region.face) << " of slice " << map.region.slice << " kappa " << map.warped.kappa;
    EXPECT_LE(strictOwners(setup, p), 1);
}

/// A corner, a point on a split plane, or anything in the frustum.
glm::dvec3 awkwardPoint(Random& random, const ShadowMapSetup& setup, const ViewFrustum& frustum) {
    const std::uint64_t kind = random.below(10);
    glm::dvec3 p = randomPointIn(random, frustum);
    if (kind == 0) p = corners(frustum)[random.below(8)];
    if (kind == 1) p *= setup.selector.splits[random.below(setup.selector.splits.size())] / p.z;
    return p;
}

enum class Shown : std::uint8_t { TheFrustum, MoreThanThat };

void checkSeed(std::uint64_t seed, int points, Shown shown = Shown::TheFrustum) {
    Random random(seed);
    ShadowView view = randomView(random);
    const ShadowOptions options = randomOptions(random, view.frustum);
    if (shown == Shown::MoreThanThat) view.shown = shownOutside(random, view.frustum);
    const DepthSpan all = view.shown.value_or(DepthSpan{view.frustum.near, view.frustum.far});
    const ShadowMapSetup setup = shadowMapSetup(view, options);
    for (int i = 0; i < points; ++i) {
        checkPoint(setup, options, awkwardPoint(random, setup, slice(view.frustum, all.near, all.far)));
        if (::testing::Test::HasFailure()) {
            ADD_FAILURE() << "seed " << seed << " light " << view.towardsLight.x << " " << view.towardsLight.y << " "
                          << view.towardsLight.z << " rule " << static_cast<int>(options.scheme.warp.rule)
                          << " stabilized " << options.stabilized << " ratio " << view.frustum.depthRatio();
            return;
        }
    }
}

TEST(Coverage, EveryPointHasOneMapThatHoldsItsLookup) {
    for (std::uint64_t seed = 0; seed < 1000 && !HasFailure(); ++seed)
        checkSeed(seed, 100);
}

TEST(Coverage, WhatIsShownBeyondTheFrustumLiesInTheMapsOfTheEndSlices) {
    for (std::uint64_t seed = 0; seed < 500 && !HasFailure(); ++seed)
        checkSeed(seed, 100, Shown::MoreThanThat);
}

TEST(SlowCoverage, EveryPointHasOneMapThatHoldsItsLookup) {
    for (std::uint64_t seed = 0; seed < 1000 && !HasFailure(); ++seed)
        checkSeed(seed, 100000);
}

TEST(Coverage, SlicesOwnTheirNearPlaneAndNotTheirFarOne) {
    const std::vector<double> splits{1, 2, 4, 8};
    EXPECT_EQ(sliceOf(splits, 1), 0U);
    EXPECT_EQ(sliceOf(splits, std::nextafter(2.0, 0.0)), 0U);
    EXPECT_EQ(sliceOf(splits, 2), 1U);
    EXPECT_EQ(sliceOf(splits, 8), 2U);
    EXPECT_EQ(sliceOf(splits, 0.5), 0U);
    EXPECT_EQ(sliceOf(splits, 100), 2U);
}

TEST(Coverage, AnEmptySliceHasNoMapAndLeavesItsTexelsToTheOthers) {
    ShadowView view;
    ShadowOptions options;
    const ShadowMapSetup all = shadowMapSetup(view, options);
    options.emptySlices = 0b0101;
    const ShadowMapSetup some = shadowMapSetup(view, options);
    ASSERT_EQ(some.maps.size(), 2U);
    EXPECT_EQ(some.mapOfPartition[0], ShadowMapSetup::kNoMap);
    EXPECT_EQ(some.mapOf({0, 0, view.frustum.far * 0.9}), 1U);
    EXPECT_LT(some.worst().worst(), all.worst().worst() * 0.75);
}

} // namespace
} // namespace gnomon::shadow
