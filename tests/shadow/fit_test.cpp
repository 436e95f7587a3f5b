// What maps are fitted with: the view frustum, the light's frame, and the extents and errors over a fitted region, each
// held from both sides.
#include "core/error.h"
#include "shadow/fit/light_fit.h"
#include "shadow/fit/light_frame.h"
#include "shadow/fit/view_frustum.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

#include <limits>

namespace gnomon::shadow {
namespace {

TEST(ViewFrustum, CornersAndPixelsAreThoseOfTheAngles) {
    const ViewFrustum frustum{2, 10, std::atan(0.5), 3};
    EXPECT_NEAR(tanHalfY(frustum), 0.5, 1e-15);
    EXPECT_NEAR(tanHalfX(frustum), 1.5, 1e-15);
    const auto points = corners(frustum);
    for (std::size_t i = 0; i < 8; ++i) {
        const double z = (i & 4U) != 0 ? 10 : 2;
        const glm::dvec3 expected((i & 1U) != 0 ? 1.5 * z : -1.5 * z, (i & 2U) != 0 ? 0.5 * z : -0.5 * z, z);
        EXPECT_NEAR(glm::distance(points[i], expected), 0, 1e-12) << i;
    }
    // 400 pixels lie over 2 * 0.5 * 8 units at depth 8.
    EXPECT_NEAR(imageBeamWidth(frustum, 8, 400), 0.02, 1e-15);
    const ViewFrustum part = slice(frustum, 3, 4);
    EXPECT_EQ(part.near, 3);
    EXPECT_EQ(part.far, 4);
    EXPECT_EQ(part.halfFovYRadians, frustum.halfFovYRadians);
    EXPECT_EQ(part.aspect, frustum.aspect);
    EXPECT_EQ(frustum.depthRatio(), 5);
}

TEST(ViewFrustum, RefusesWhatIsNone) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NO_THROW(requireValid(ViewFrustum{1, 1.0001, 1e-6, 1e-3}));
    for (const ViewFrustum& bad :
         {ViewFrustum{0, 1, 0.5, 1},
          ViewFrustum{-1, 1, 0.5, 1},
          ViewFrustum{1, 1, 0.5, 1},
          ViewFrustum{2, 1, 0.5, 1},
          ViewFrustum{1, infinity, 0.5, 1},
          ViewFrustum{nan, 1, 0.5, 1},
          ViewFrustum{1, 2, 0, 1},
          ViewFrustum{1, 2, kPi / 2, 1},
          ViewFrustum{1, 2, 0.5, 0},
          ViewFrustum{1, 2, 0.5, infinity}})
        EXPECT_THROW(requireValid(bad), Error) << bad.near << " " << bad.far << " " << bad.aspect;
}

TEST(LightFrame, IsTheConvention) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 light = randomLight(random);
        const LightFrame frame = lightFrame(light);
        EXPECT_EQ(frame.y, light);
        EXPECT_NEAR(glm::length(frame.x), 1, 1e-12);
        EXPECT_NEAR(glm::dot(frame.x, light), 0, 1e-12);
        EXPECT_NEAR(glm::distance(glm::cross(frame.x, light), frame.z), 0, 1e-12);
        if (sinLightAngle(light) >= 1e-12) {
            EXPECT_GT(frame.z.z, 0) << "z follows the view";
            EXPECT_NEAR(frame.x.z, 0, 1e-12) << "x is across it";
        } else {
            EXPECT_GT(frame.z.y, 0) << "up stands in";
        }
        const glm::dvec3 p = randomDirection(random) * 100.0;
        EXPECT_NEAR(glm::distance(toCamera(frame, toLight(frame, p)), p), 0, 1e-10);
        EXPECT_NEAR(toLight(frame, p).y, glm::dot(p, light), 1e-12);
    }
}

TEST(LightFrame, RollsFromZTowardsX) {
    const LightFrame frame;
    EXPECT_NEAR(glm::distance(rolled(frame, kPi / 2).z, frame.x), 0, 1e-15);
    EXPECT_NEAR(glm::distance(rolled(frame, kPi / 2).x, -frame.z), 0, 1e-15);
    EXPECT_NEAR(glm::dot(rolled(frame, 0.3).z, frame.z), std::cos(0.3), 1e-15);
    EXPECT_NEAR(glm::distance(rolled(rolled(frame, 0.3), 0.4).z, rolled(frame, 0.7).z), 0, 1e-15);
}

/// A random slice in a random frame with a random warp.
struct Fitted {
    ViewFrustum frustum;
    LightFit fit;
    double kappa = 0;
};

Fitted randomFit(Random& random) {
    Fitted result;
    result.frustum = randomFrustum(random);
    result.fit = fitSlice(rolled(lightFrame(randomLight(random)), random.uniform(-3, 3)), result.frustum);
    result.kappa = random.below(4) == 0 ? 0 : std::pow(10.0, random.uniform(-3, 1)) / result.fit.length;
    return result;
}

TEST(LightFit, ZetaRunsFromZeroToItsLength) {
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const auto [frustum, fit, kappa] = randomFit(random);
        double min = std::numeric_limits<double>::infinity();
        double max = -min;
        ASSERT_EQ(fit.points().size(), 8U);
        const auto points = corners(frustum);
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const FitPoint& point = fit.points()[corner];
            min = std::min(min, point.zeta);
            max = std::max(max, point.zeta);
            const glm::dvec3 inLight = toLight(fit.frame, points[corner]);
            EXPECT_NEAR(inLight.x, point.x, 1e-12 * frustum.far);
            EXPECT_NEAR(inLight.z, point.zeta + fit.zMin, 1e-9 * frustum.far);
            EXPECT_EQ(point.end, corner < 4 ? DepthEnd::Near : DepthEnd::Far);
            EXPECT_EQ(point.depth, points[corner].z);
        }
        EXPECT_EQ(min, 0);
        EXPECT_EQ(max, fit.length);
    }
}

TEST(LightFit, ARolledFitIsTheFitOfTheRolledFrame) {
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const auto [frustum, fit, kappa] = randomFit(random);
        const double radians = random.uniform(-3, 3);
        const LightFit found = rolled(fit, radians);
        const LightFit expected = fitSlice(rolled(fit.frame, radians), frustum);
        EXPECT_NEAR(found.length, expected.length, 1e-9 * frustum.far);
        EXPECT_NEAR(found.zMin, expected.zMin, 1e-9 * frustum.far);
        for (std::size_t corner = 0; corner < 8; ++corner) {
            EXPECT_NEAR(found.points()[corner].x, expected.points()[corner].x, 1e-9 * frustum.far);
            EXPECT_NEAR(found.points()[corner].zeta, expected.points()[corner].zeta, 1e-9 * frustum.far);
        }
    }
}

/// Every measure of a fit is the largest over the region: no point of it is above, and one of its corners comes up to
/// it.
TEST(LightFit, ExtentsAndErrorsAreReachedAndNotPassed) {
    Random random(4);
    for (int round = 0; round < 500; ++round) {
        const Fitted fitted = randomFit(random); // no structured bindings: clang 14 lets no lambda catch those
        const ViewFrustum& frustum = fitted.frustum;
        const LightFit& fit = fitted.fit;
        const double kappa = fitted.kappa;
        const WarpedExtent extent = warpedExtent(fit, kappa);
        const Aliasing aliasingBound = worstAliasing(fit, kappa);
        const double sheared = worstShearedAliasing(fit, kappa);
        const WarpedMap map = warpedMap(fit, kappa);
        WarpedExtent found{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
        Aliasing worst;
        double worstSheared = 0;
        const auto include = [&](const glm::dvec3& p) {
            const glm::dvec3 inLight = toLight(fit.frame, p);
            const double u = inLight.x / (1 + kappa * (inLight.z - fit.zMin));
            found = {std::min(found.min, u), std::max(found.max, u)};
            const LightBeam beam = lightBeam(map, p, {});
            const double pixel = imageBeamWidth(frustum, p.z, 1);
            worst = {std::max(worst.x, beam.x / pixel), std::max(worst.z, beam.z / pixel)};
            worstSheared = std::max(worstSheared, beam.sheared / pixel);
        };
        for (int i = 0; i < 30; ++i)
            include(randomPointIn(random, frustum));
        for (const glm::dvec3& corner : corners(frustum))
            include(corner);
        const double size = extent.width();
        EXPECT_NEAR(found.min, extent.min, 1e-9 * size);
        EXPECT_NEAR(found.max, extent.max, 1e-9 * size);
        EXPECT_NEAR(worst.x / aliasingBound.x, 1, 1e-9);
        EXPECT_NEAR(worst.z / aliasingBound.z, 1, 1e-9);
        EXPECT_NEAR(storageFactor(fit, kappa) / (aliasingBound.x * aliasingBound.z), 1, 1e-12);
        const double shear = kappa * std::max(std::abs(extent.min), std::abs(extent.max));
        EXPECT_LE(worstSheared, sheared * (1 + 1e-9));
        const double slack = shear > std::sqrt(2.0) ? std::sqrt(1 + shear * shear) : 1;
        EXPECT_GE(worstSheared * slack, sheared * (1 - 1e-9));
        EXPECT_GE(sheared, aliasingBound.z * (1 - 1e-12));
    }
}

} // namespace
} // namespace gnomon::shadow
