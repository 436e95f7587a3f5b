// Finite differences of the real matrices against the beam widths, the aliasing and the Jacobian.
#include "shadow/warp/warped_map.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

/// (s, t, depth) by the 4x4 matrix alone.
glm::dvec3 byMatrix(const glm::dmat4& m, const glm::dvec3& p) {
    const glm::dvec4 at = m * glm::dvec4(p, 1);
    return glm::dvec3(at) / at.w;
}

/// Central differences along `direction`, once and with half the step: their difference bounds the truncation error.
struct Difference {
    glm::dvec3 value{0};
    double error = 0;
};

Difference differenceAlong(const glm::dmat4& m, const glm::dvec3& p, const glm::dvec3& direction, double step) {
    const auto at = [&](double h) {
        return (byMatrix(m, p + direction * h) - byMatrix(m, p - direction * h)) / (2 * h);
    };
    const glm::dvec3 coarse = at(step);
    const glm::dvec3 fine = at(step / 2);
    // Truncation falls by four with half the step; rounding of values of the size of 1 grows with 1 / step.
    return {fine, glm::length(fine - coarse) + 4e-15 * (1 + glm::length(byMatrix(m, p))) / step};
}

void checkSeed(std::uint64_t seed) {
    Random random(seed);
    const ViewFrustum frustum = randomFrustum(random);
    const LightFrame frame = rolled(lightFrame(randomLight(random)), random.below(2) == 0 ? 0 : random.uniform(-3, 3));
    const LightFit fit = fitSlice(frame, frustum);
    const double kappa = kappaOf(randomWarp(random, frustum), fit); // even rows: the matrix's
    const WarpedMap map = warpedMap(fit, kappa);
    const glm::dmat4 matrix = textureFromCamera(map);
    const glm::dvec3 p = randomPointIn(random, frustum);
    const MapPoint point = mapPoint(map, p);
    const glm::dvec3 closed(point.s, point.t, point.depth);
    const double scale = 1 + glm::length(closed);
    ASSERT_NEAR(glm::length(byMatrix(matrix, p) - closed) / scale, 0, 1e-9) << "seed " << seed;

    const MapJacobian jacobian = mapJacobian(map, p);
    // A step over which w changes by about a thousandth.
    const double step = 1e-3 * point.w / std::max(kappa, 1 / map.length);
    for (const glm::dvec3& axis : {frame.x, frame.y, frame.z, randomDirection(random)}) {
        const Difference found = differenceAlong(matrix, p, axis, step);
        const glm::dvec3 expected(
            glm::dot(jacobian.s, axis), glm::dot(jacobian.t, axis), glm::dot(jacobian.depth, axis));
        ASSERT_LE(glm::length(found.value - expected), 2 * found.error + 1e-9 * glm::length(expected))
            << "seed " << seed << " kappa d " << kappa * map.length;
    }

    // One texel of a map with unit resolution: the step in x, and in z, that moves s, and t, by 1.
    const LightBeam beam = lightBeam(map, p, {});
    const Difference alongX = differenceAlong(matrix, p, frame.x, step);
    const Difference alongZ = differenceAlong(matrix, p, frame.z, step);
    ASSERT_NEAR(alongX.value.x * beam.x, 1, 2 * alongX.error * beam.x + 1e-9) << "seed " << seed;
    ASSERT_NEAR(alongZ.value.y * beam.z, 1, 2 * alongZ.error * beam.z + 1e-9) << "seed " << seed;

    // A pixel's image beam, from the projection y / (2 z tan): the height that moves the image by one pixel.
    const double tanY = tanHalfY(frustum);
    const double h = 1e-4 * p.z;
    const double pixels = 600;
    const double slope = ((p.y + h) - (p.y - h)) / (2 * p.z * tanY) / (2 * h) * pixels;
    ASSERT_NEAR(slope * imageBeamWidth(frustum, p.z, pixels), 1, 1e-9);
}

TEST(Differences, OfTheMatrixAreTheJacobianAndTheBeams) {
    for (std::uint64_t seed = 0; seed < 10000 && !HasFatalFailure(); ++seed)
        checkSeed(seed);
}

TEST(Differences, TheOverheadFormsAreTheGeneralOnes) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        ViewFrustum frustum = randomFrustum(random);
        frustum.aspect = 1;
        const LightFit fit = fitSlice(lightFrame({0, 1, 0}), frustum);
        const double nPrime = frustum.near * std::pow(10.0, random.uniform(0, 3));
        const Aliasing closed = worstAliasingOverhead(frustum, nPrime);
        const Aliasing general = worstAliasing(fit, 1 / nPrime);
        EXPECT_NEAR(general.x / closed.x, 1, 1e-9);
        EXPECT_NEAR(general.z / closed.z, 1, 1e-9);
        EXPECT_NEAR(general.x * general.z / storageFactorOverhead(frustum, nPrime), 1, 1e-9);
        EXPECT_NEAR(1 / kappaMinimax(fit) / nPrimeLspsm(frustum), 1, 1e-9);
    }
}

} // namespace
} // namespace gnomon::shadow
