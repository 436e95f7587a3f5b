// The deviation of a simplified patch where it is known exactly, and against dense samples where it is not: a bound
// that is too large is as wrong as one that is too small.
#include "preprocess/simplify/hausdorff_bound.h"
#include "preprocess/simplify/simplify.h"
#include "tests/support/patches.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::simplify {
namespace {

using hierarchy::kNone;

/// n x n squares of side 10 in the plane z = 0.
Patch flatSheet(std::uint32_t n) {
    std::vector<glm::dvec3> positions;
    std::vector<Triangle> triangles;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x)
            positions.emplace_back(10 * x, 10 * y, 0);
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x;
            triangles.push_back({a, a + 1, a + n + 2});
            triangles.push_back({a, a + n + 2, a + n + 1});
        }
    return plainPatch(std::move(positions), std::move(triangles));
}

/// `triangles` of the patch's vertices, of which nothing is known.
SimplifiedPatch unknownOrigin(const Patch& patch, std::vector<Triangle> triangles) {
    SimplifiedPatch simplified;
    simplified.triangles = std::move(triangles);
    simplified.origin.assign(simplified.triangles.size(), kNone);
    for (std::uint32_t p = 0; p < patch.positions.size(); ++p)
        simplified.movedTo.push_back(p);
    return simplified;
}

double worstOf(const HausdorffBound& measured) {
    double worst = 0;
    for (const TriangleError& error : measured.errors)
        worst = std::max({worst, double{error.fromSource}, double{error.toSource}});
    return worst;
}

TEST(HausdorffBound, OfWhatDidNotChangeIsWhatItWas) {
    Patch patch = patchOf(read::bumpySheet(6));
    Random random(1);
    std::vector<TriangleError> errors(patch.triangles.size());
    for (TriangleError& error : errors)
        error = {static_cast<float>(random.unit()), static_cast<float>(random.unit())};
    patch.errors = errors;
    SimplifiedPatch same = unknownOrigin(patch, patch.triangles);
    for (std::uint32_t t = 0; t < same.origin.size(); ++t)
        same.origin[t] = t;
    const HausdorffBound measured = measureHausdorffBound(patch, same, 0);
    ASSERT_EQ(measured.errors.size(), errors.size());
    for (std::size_t t = 0; t < errors.size(); ++t) {
        EXPECT_EQ(measured.errors[t].fromSource, errors[t].fromSource);
        EXPECT_EQ(measured.errors[t].toSource, errors[t].toSource);
    }
    EXPECT_EQ(measured.worst, worstOf(measured));
}

TEST(HausdorffBound, OfAPlaneInOtherTrianglesIsNothing) {
    const Patch patch = flatSheet(8);
    const std::uint32_t last = 80;
    const HausdorffBound measured =
        measureHausdorffBound(patch, unknownOrigin(patch, {{0, 8, last}, {0, last, 72}}), 0);
    EXPECT_LT(measured.worst, 1e-9);
    EXPECT_LT(worstOf(measured), 1e-9);
}

TEST(HausdorffBound, OfAPeakCutOffIsItsHeight) {
    for (const double height : {1.0, 7.0, 30.0}) {
        Patch patch = flatSheet(8);
        patch.positions[40].z = height; // the middle
        const HausdorffBound measured =
            measureHausdorffBound(patch, unknownOrigin(patch, {{0, 8, 80}, {0, 80, 72}}), 0);
        double fromSource = 0;
        for (const TriangleError& error : measured.errors)
            fromSource = std::max(fromSource, double{error.fromSource});
        EXPECT_GE(fromSource, height);
        EXPECT_LE(fromSource, height * (1 + 1e-6));
        EXPECT_GE(measured.worst, height);
        EXPECT_LE(measured.worst, height * (1 + 1e-6));
    }
}

TEST(HausdorffBound, OfAPartThatVanishedIsItsDistance) {
    Patch patch = flatSheet(4);
    const auto first = static_cast<std::uint32_t>(patch.positions.size());
    for (const glm::dvec3 corner : {glm::dvec3(12, 11, 25), glm::dvec3(17, 11, 25), glm::dvec3(12, 18, 25)}) {
        patch.positionOf.push_back(static_cast<std::uint32_t>(patch.positions.size()));
        patch.positions.push_back(corner);
        patch.vertices.emplace_back();
        patch.isLocked.push_back(0);
    }
    std::vector<Triangle> sheet = patch.triangles;
    patch.triangles.push_back({first, first + 1, first + 2});
    const HausdorffBound measured = measureHausdorffBound(patch, unknownOrigin(patch, std::move(sheet)), 0);
    EXPECT_GE(measured.worst, 25);
    EXPECT_LE(measured.worst, 25 * (1 + 1e-6));
}

TEST(HausdorffBound, AddsToWhatWasKnownOfTheTrianglesThatStoodThere) {
    Patch patch = flatSheet(4);
    const std::vector<TriangleError> errors(patch.triangles.size(), {3, 5});
    patch.errors = errors;
    const HausdorffBound measured = measureHausdorffBound(patch, unknownOrigin(patch, {{0, 4, 24}, {0, 24, 20}}), 0);
    for (const TriangleError& error : measured.errors) {
        EXPECT_NEAR(error.fromSource, 3, 1e-6);
        EXPECT_NEAR(error.toSource, 5, 1e-6);
    }
}

/// The largest distance of dense samples on each side from the other one.
double sampledDistance(const Patch& patch, const std::vector<Triangle>& simplified) {
    Random random(7);
    double worst = 0;
    const std::array sides{&patch.triangles, &simplified};
    for (std::size_t side = 0; side < sides.size(); ++side)
        for (const Triangle& t : *sides[side])
            for (int sample = 0; sample < 40; ++sample) {
                const glm::dvec3 p = randomPoint(patch, t, random);
                double nearest = std::numeric_limits<double>::infinity();
                for (const Triangle& other : *sides[1 - side])
                    nearest = std::min(nearest, distanceTo(patch, p, other));
                worst = std::max(worst, nearest);
            }
    return worst;
}

TEST(HausdorffBound, IsNotMuchMoreThanDenseSamplesShow) {
    for (const Simplifier simplifier : {Simplifier::Meshopt, Simplifier::OpenMesh}) {
        const Patch patch = patchOf(read::bumpySheet(10));
        const SimplifiedPatch simplified = simplify(patch, 70, simplifier);
        const double sampled = sampledDistance(patch, simplified.triangles);
        const double bound = measureHausdorffBound(patch, simplified, 0).worst;
        EXPECT_GE(bound, sampled);
        EXPECT_LE(bound, sampled * 1.3);
        const double tolerance = sampled * 2;
        EXPECT_LE(measureHausdorffBound(patch, simplified, tolerance).worst, tolerance + sampled);
    }
}

} // namespace
} // namespace gnomon::simplify
