// Slices, faces and regions: where they are cut, which faces bear maps, and regions that are no larger than they own.
#include "shadow/partition/faces.h"
#include "shadow/partition/region.h"
#include "shadow/partition/splits.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::shadow {
namespace {

TEST(Splits, AreSelfSimilarOrEvenOrBetween) {
    for (const int count : {1, 2, 4, 7}) {
        const std::vector<double> similar = selfSimilarSplits(0.5, 200, count);
        const std::vector<double> even = practicalSplits(0.5, 200, count, 0);
        const std::vector<double> between = practicalSplits(0.5, 200, count, 0.25);
        ASSERT_EQ(similar.size(), static_cast<std::size_t>(count) + 1);
        ASSERT_EQ(even.size(), similar.size());
        for (std::size_t i = 0; i < similar.size(); ++i) {
            const double part = static_cast<double>(i) / count;
            EXPECT_NEAR(similar[i], 0.5 * std::pow(400, part), 1e-9);
            EXPECT_NEAR(even[i], 0.5 + 199.5 * part, 1e-9);
            EXPECT_NEAR(between[i], 0.25 * similar[i] + 0.75 * even[i], 1e-9);
        }
        EXPECT_EQ(similar.front(), 0.5);
        EXPECT_EQ(similar.back(), 200);
        EXPECT_NEAR(sliceRatioMinusOne(0.5, 200, count), std::pow(400, 1.0 / count) - 1, 1e-9);
    }
}

TEST(Faces, ThatBearMapsAreThoseOfTheLightsSide) {
    const ViewFrustum frustum{1, 10, 0.5, 1};
    using Faces = std::vector<Face>;
    EXPECT_EQ(sideFaces(frustum, {0, 1, 0}), (Faces{Face::Top}));
    EXPECT_EQ(sideFaces(frustum, {0, -1, 0}), (Faces{Face::Bottom}));
    EXPECT_EQ(sideFaces(frustum, {-1, 0, 0}), (Faces{Face::Left}));
    EXPECT_EQ(sideFaces(frustum, {1, 0, 0}), (Faces{Face::Right}));
    const Faces all{Face::Top, Face::Bottom, Face::Left, Face::Right};
    EXPECT_EQ(sideFaces(frustum, {0, 0, -1}), all) << "from behind the viewer all faces look at the light";
    EXPECT_EQ(sideFaces(frustum, {0, 0, 1}), all) << "and from the front all look away";
    EXPECT_TRUE(sideFaces(frustum, {0, 0, -1}, 0.99).empty()) << "where that is grazing";
    EXPECT_STREQ(name(Face::Top), "top");
    EXPECT_STREQ(name(Face::Whole), "whole");
}

TEST(Faces, HaveTheirCornersInTheirPlane) {
    const ViewFrustum frustum{1, 10, 0.4, 1.7};
    for (const Face face : {Face::Top, Face::Bottom, Face::Left, Face::Right}) {
        const glm::dvec3 normal = outwardNormal(frustum, face);
        const auto vertices = faceVertices(frustum, face);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(glm::dot(normal, vertices[i].position), 0, 1e-12) << name(face);
            EXPECT_EQ(vertices[i].end, i < 2 ? DepthEnd::Near : DepthEnd::Far);
        }
        EXPECT_LT(glm::dot(normal, glm::dvec3(0, 0, 5)), 0) << "outward";
        // The bisector has both edges at the same angle, seen along the light.
        const glm::dvec3 light = glm::normalize(glm::dvec3(0.3, 0.5, -0.2));
        const LightFrame frame = faceFrame(frustum, light, face, Bisector::Normalized);
        const auto across = [&](std::size_t side) {
            const glm::dvec3 edge = toLight(frame, vertices[side + 2].position - vertices[side].position);
            return edge.x / std::hypot(edge.x, edge.z);
        };
        EXPECT_NEAR(across(0), -across(1), 1e-9) << name(face);
    }
    EXPECT_EQ(outwardNormal(frustum, Face::Near), glm::dvec3(0, 0, -1)) << "towards the eye";
}

/// A point of the region, in a random convex combination of its vertices.
glm::dvec3 pointOf(Random& random, const Region& region) {
    glm::dvec3 sum(0);
    double total = 0;
    for (const FitVertex& vertex : region.vertices) {
        const double weight = std::pow(random.unit(), 3.0);
        sum += vertex.position * weight;
        total += weight;
    }
    return sum / total;
}

FaceMaps facesOf(const Scheme& scheme) {
    if (!scheme.faces) return FaceMaps::None;
    return scheme.nearFace == NearFace::OwnMap ? FaceMaps::SidesAndNear : FaceMaps::Sides;
}

/// How deep a point lies in a region: its distance from the nearest plane, less than 0 outside.
double depthInside(const Region& region, const glm::dvec3& p) {
    double inside = std::numeric_limits<double>::infinity();
    for (const Plane& plane : region.volume.planes)
        inside = std::min(inside, plane.signedDistance(p));
    return inside;
}

/// The distance of a region's nearest corner from one of its planes; 0 where the plane touches it.
double slack(const Region& region, const Plane& plane) {
    double min = std::numeric_limits<double>::infinity();
    for (const FitVertex& vertex : region.vertices)
        min = std::min(min, plane.signedDistance(vertex.position));
    return min;
}

/// A region holds what its partition owns, and what lies inside it by a margin nobody else owns.
TEST(Regions, AreNoLargerThanWhatTheirPartitionOwns) {
    int tested = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const ShadowView view = randomView(random);
        const ShadowOptions options = randomOptions(random, view.frustum);
        const auto& [near, far, theta, aspect] = view.frustum;
        const PartitionSelector selector = partitionSelector(
            view.frustum,
            view.towardsLight,
            practicalSplits(near, far, options.scheme.slices, 1),
            facesOf(options.scheme));
        for (std::size_t i = 0; i < selector.partitionCount(); ++i) {
            const Region region = partitionRegion(view.frustum, selector, i);
            EXPECT_EQ(region.slice, i / selector.facesPerSlice());
            for (const Plane& plane : region.volume.planes)
                EXPECT_NEAR(slack(region, plane) / region.frustum.far, 0, 1e-9)
                    << "seed " << seed << ": a plane can be moved in";
            const glm::dvec3 p = pointOf(random, region);
            if (depthInside(region, p) < 2e-3 * region.frustum.far) continue; // merged slivers: a thousandth off
            ++tested;
            EXPECT_EQ(partitionIndex(selector, p), i) << "seed " << seed << " " << name(region.face);
        }
    }
    EXPECT_GT(tested, 200);
}

TEST(Regions, SeenCornersHoldEachOfManyParts) {
    int held = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const ShadowView view = randomView(random);
        const PartitionSelector selector =
            partitionSelector(view.frustum, view.towardsLight, {view.frustum.near, view.frustum.far}, FaceMaps::None);
        const Region region = partitionRegion(view.frustum, selector, 0);
        std::vector<VisibleSlab> seen;
        std::vector<glm::dvec3> inside;
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 middle = randomPointIn(random, view.frustum);
            const double half = middle.z * random.uniform(0.01, 0.1);
            const glm::dvec3 inWorld = toWorld(view.anchor.basis, middle);
            seen.push_back({{middle.z - half, middle.z + half}, {inWorld - half, inWorld + half}});
            inside.push_back(middle);
        }
        const std::vector<glm::dvec3> points = seenCorners(region, seen, view.anchor.basis);
        for (const glm::dvec3& p : inside)
            for (int i = 0; i < 20; ++i) {
                const glm::dvec3 direction = randomDirection(random);
                double furthest = -std::numeric_limits<double>::infinity();
                for (const glm::dvec3& corner : points)
                    furthest = std::max(furthest, glm::dot(corner, direction));
                EXPECT_GE(furthest, glm::dot(p, direction) - 1e-6 * view.frustum.far) << "seed " << seed;
                ++held;
            }
    }
    EXPECT_GT(held, 1000);
}

TEST(Regions, SeenCornersHoldWhatIsSeenAndNothingFurther) {
    int held = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const ShadowView view = randomView(random);
        const ViewFrustum& frustum = view.frustum;
        const PartitionSelector selector =
            partitionSelector(frustum, view.towardsLight, {frustum.near, frustum.far}, FaceMaps::None);
        const Region region = partitionRegion(frustum, selector, 0);
        const glm::dvec3 middle = randomPointIn(random, frustum);
        const double half = middle.z * random.uniform(0.01, 0.3);
        const glm::dvec3 inWorld = toWorld(view.anchor.basis, middle);
        const DepthSpan depths{middle.z - half * random.unit(), middle.z + half * random.unit()};
        const std::vector<VisibleSlab> seen{{depths, {inWorld - half, inWorld + half}}};
        const std::vector<glm::dvec3> points = seenCorners(region, seen, view.anchor.basis);
        const double slack = 1e-6 * (frustum.far + half);
        for (const glm::dvec3& p : points) {
            const glm::dvec3 offset = glm::abs(toWorld(view.anchor.basis, p) - inWorld);
            EXPECT_LE(std::max({offset.x, offset.y, offset.z}), half + slack) << "outside of the box, seed " << seed;
            EXPECT_GE(p.z, std::max(depths.near, frustum.near) - slack) << "seed " << seed;
            EXPECT_LE(p.z, std::min(depths.far, frustum.far) + slack) << "seed " << seed;
            for (const Plane& plane : region.volume.planes)
                EXPECT_GE(plane.signedDistance(p), -slack) << "outside of the region, seed " << seed;
        }
        // In every direction the corners reach as far as anything seen.
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 p =
                middle +
                toCamera(
                    view.anchor.basis,
                    glm::dvec3(random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)));
            if (!contains(region.volume, p) || p.z < depths.near || p.z > depths.far) continue;
            ++held;
            const glm::dvec3 direction = randomDirection(random);
            double furthest = -std::numeric_limits<double>::infinity();
            for (const glm::dvec3& corner : points)
                furthest = std::max(furthest, glm::dot(corner, direction));
            EXPECT_GE(furthest, glm::dot(p, direction) - slack) << "seed " << seed;
        }
    }
    EXPECT_GT(held, 1000);
}

} // namespace
} // namespace gnomon::shadow
