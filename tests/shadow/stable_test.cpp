// Stable slices, and the quantised near.
#include "shadow/quantized_near.h"
#include "shadow/stable_slice.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

/// The texel that a world point falls into in the map of `view`, and its depth in steps of the map's texel.
glm::dvec3 worldTexel(const ShadowMap& map, const ShadowView& view, const glm::dvec3& world) {
    const glm::dvec3 p = gnomon::toCamera(view.anchor.basis, world - view.anchor.eye);
    const MapPoint at = mapPoint(map.warped, p);
    const int texels = map.rectangle.width - 2;
    return {at.s * texels, at.t * texels, at.depth * map.warped.rawRange / map.warped.width * texels};
}

TEST(Stable, WorldPointsKeepTheirPlaceInTheTexelsAsTheCameraMovesAndTurns) {
    Random random(1);
    for (int round = 0; round < 100; ++round) {
        ShadowOptions options;
        options.stabilized = true;
        const glm::dvec3 lightWorld = randomDirection(random);
        ShadowView view;
        view.frustum = {0.5, 200, 0.5, 1.5};
        Camera camera;
        camera.eye = randomDirection(random) * 1e4;
        camera.target = camera.eye + randomDirection(random);
        std::vector<ShadowMapSetup> setups;
        std::vector<ShadowView> views;
        for (int frame = 0; frame < 4; ++frame) {
            view.anchor = {cameraBasis(camera), camera.eye};
            view.towardsLight = gnomon::toCamera(view.anchor.basis, lightWorld);
            views.push_back(view);
            setups.push_back(shadowMapSetup(view, options));
            camera.eye += randomDirection(random) * 0.3;
            camera.target = camera.eye + glm::normalize(camera.target - camera.eye + randomDirection(random) * 0.1);
        }
        for (std::size_t slice = 0; slice < setups[0].maps.size(); ++slice) {
            const glm::dvec3 world = randomDirection(random) * 1e4;
            const glm::dvec3 first = worldTexel(setups[0].maps[slice], views[0], world);
            for (std::size_t frame = 1; frame < setups.size(); ++frame) {
                ASSERT_EQ(setups[frame].maps[slice].rectangle, setups[0].maps[slice].rectangle);
                const glm::dvec3 moved = worldTexel(setups[frame].maps[slice], views[frame], world) - first;
                EXPECT_NEAR(moved.x, std::round(moved.x), 1e-5);
                EXPECT_NEAR(moved.y, std::round(moved.y), 1e-5);
                EXPECT_NEAR(moved.z, std::round(moved.z), 1e-5);
            }
        }
    }
}

TEST(Stable, ItsStorageFactorIsTheTheorys) {
    // theory: a stable, unwarped, diagonal-fitted k = 4 costs 253 everywhere (alpha 1000, theta 20 degrees).
    const ViewFrustum frustum{1, 1000, 20 * kPi / 180, 1};
    const std::vector<double> splits = selfSimilarSplits(1, 1000, 4);
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const ViewFrustum part = slice(frustum, splits[i], splits[i + 1]);
        const double m = stableExtent(part) / (2 * tanHalfY(part) * part.near);
        sum += m * m;
    }
    EXPECT_NEAR(sum, 253, 1);
}

TEST(QuantizedNear, FallsAtOnceAndRisesAfterSomeFrames) {
    NearState state = nextNear({}, 1.0, 0.001);
    EXPECT_EQ(state.near, 1);
    state = nextNear(state, 0.3, 0.001);
    EXPECT_LE(state.near, 0.3);
    EXPECT_GE(state.near, 0.3 / std::exp2(0.25) * (1 - 1e-12));
    const double low = state.near;
    for (int frame = 0; frame < 14; ++frame) {
        state = nextNear(state, 2, 0.001);
        EXPECT_EQ(state.near, low);
    }
    state = nextNear(state, 2, 0.001);
    EXPECT_EQ(state.near, 2);
    EXPECT_EQ(state.framesAbove, 0) << "the next wait begins anew";
    for (int frame = 0; frame < 40; ++frame) // one dip in between starts the wait anew
        state = nextNear(state, frame % 10 == 0 ? 2 : 4, 0.001);
    EXPECT_EQ(state.near, 2);
    EXPECT_EQ(nextNear({}, 1e-9, 0.5).near, 0.5);
}

TEST(QuantizedNear, StepsArePowersOfTheFourthRootOfTwo) {
    for (int i = -80; i < 80; ++i) {
        const double step = std::exp2(i / 4.0);
        EXPECT_NEAR(quantizeNear(step) / step, 1, 1e-11);
        EXPECT_NEAR(quantizeNear(step * 1.1) / step, 1, 1e-11);
        EXPECT_LE(quantizeNear(step), step);
    }
}

} // namespace
} // namespace gnomon::shadow
