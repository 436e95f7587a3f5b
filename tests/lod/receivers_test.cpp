// Depth range and receivers against looking at every triangle of every drawn cluster.
#include "lod/receivers.h"
#include "lod/triangle_clip.h"
#include "lod/visible_depths.h"
#include "seen_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace gnomon::lod {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

double missingError(const lod::CutQuery& query, const hierarchy::Page& page, const hierarchy::Cluster& cluster) {
    if (cluster.refinement == hierarchy::kNone) return 0;
    const hierarchy::Refinement& finer = page.refinements[cluster.refinement];
    return query.rule->pixels(finer.bounds, tests::largerError(finer)) > query.errorPixels ? finer.error : 0;
}

TEST(Receivers, DepthRangeIsThatOfAllTriangles) {
    Random random(61);
    int seen = 0;
    std::uint64_t measured = 0;
    std::uint64_t drawn = 0;
    for (int trial = 0; trial < 150; ++trial) {
        const Seen scene(random);
        TriangleClipper clipper(scene.volumes[0]);
        double min = kEndless;
        double greatest = -kEndless;
        forEveryTriangle(
            scene.query(), scene.cut.lists.image, [&](const auto& corners, const auto& page, const auto& cluster) {
                const double margin = missingError(scene.query(), page, cluster);
                for (const glm::dvec3& point : clipper.clipped(corners)) {
                    const double depth = std::max(0.0, glm::dot(scene.view.basis.view, point - scene.view.eye));
                    min = std::min(min, std::max(0.0, depth - margin));
                    greatest = std::max(greatest, depth + margin);
                }
            });
        const std::optional<VisibleDepths> range = visibleDepthRange(scene.query(), scene.cut.lists.image);
        ASSERT_EQ(range.has_value(), min != kEndless);
        if (!range) continue;
        ++seen;
        EXPECT_EQ(range->span.near, min);
        EXPECT_EQ(range->span.far, greatest);
        measured += range->clustersMeasured;
        drawn += scene.cut.lists.image.clusters;
    }
    EXPECT_GT(seen, 50);
    EXPECT_LT(measured * 4, drawn) << "few clusters are to be looked at triangle by triangle";
}

/// Whether one of `parts` says that `point` (relative to the eye, at `depth`) may be seen.
bool isWithin(const std::vector<shadow::VisibleSlab>& parts, const glm::dvec3& point, double depth, double slack) {
    return std::any_of(parts.begin(), parts.end(), [&](const shadow::VisibleSlab& part) {
        if (depth < part.depths.near - slack || depth > part.depths.far + slack) return false;
        const glm::dvec3 outside = glm::max(part.box.min - point, point - part.box.max);
        return std::max({outside.x, outside.y, outside.z}) <= slack;
    });
}

TEST(Receivers, SeenPartsHoldAllThatIsSeenAtItsDepth) {
    Random random(67);
    int points = 0;
    double held = 0;  // volumes of the parts' boxes
    double whole = 0; // and of one box for all
    for (int trial = 0; trial < 40; ++trial) {
        const Seen scene(random);
        const std::optional<VisibleDepths> range = visibleDepthRange(scene.query(), scene.cut.lists.image);
        if (!range || !(range->span.far > 0)) continue;
        const DepthSpan depths{std::max(range->span.near, range->span.far * 1e-4), range->span.far};
        const std::vector<shadow::VisibleSlab> parts = visibleSlabs(scene.query(), scene.cut.lists.image, depths);
        Box all;
        for (const shadow::VisibleSlab& part : parts) {
            all.add(part.box);
            held += part.box.extent().x * part.box.extent().y * part.box.extent().z / static_cast<double>(parts.size());
        }
        whole += all.extent().x * all.extent().y * all.extent().z;
        TriangleClipper clipper(scene.volumes[0]);
        forEveryTriangle(scene.query(), scene.cut.lists.image, [&](const auto& corners, const auto&, const auto&) {
            for (const glm::dvec3& corner : clipper.clipped(corners)) {
                const glm::dvec3 point = corner - scene.view.eye;
                const double depth = glm::dot(scene.view.basis.view, point);
                const double counted = std::clamp(depth, depths.near, depths.far);
                EXPECT_TRUE(isWithin(parts, point, counted, 1e-9 * range->span.far)) << trial << " at " << depth;
                ++points;
            }
        });
    }
    EXPECT_GT(points, 10000);
    EXPECT_LT(held * 3, whole) << "a part is less than all of it";
}

TEST(Receivers, AVolumeReceivesWhereATriangleIs) {
    Random random(62);
    int receiving = 0;
    int empty = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const Seen scene(random);
        std::vector<ConvexVolume> slices;
        for (const lod::CasterDetail& caster : tests::randomCasters(random, scene.view))
            slices.push_back(caster.receivers);
        const std::vector<bool> found = receivingVolumes(scene.query(), scene.cut.lists.image, slices);
        for (std::size_t v = 0; v < slices.size(); ++v) {
            ConvexVolume both = slices[v];
            both.planes.insert(both.planes.end(), scene.volumes[0].planes.begin(), scene.volumes[0].planes.end());
            TriangleClipper clipper(both);
            bool expected = false;
            forEveryTriangle(scene.query(), scene.cut.lists.image, [&](const auto& corners, const auto&, const auto&) {
                expected = expected || !clipper.clipped(corners).empty();
            });
            EXPECT_EQ(found[v], expected);
            ++(expected ? receiving : empty);
        }
    }
    EXPECT_GT(receiving, 10);
    EXPECT_GT(empty, 10);
}

// The truth beside the clipper: random points of the triangle.
TEST(TriangleClipper, KeepsWhatTheVolumeHolds) {
    Random random(63);
    int cut = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const auto point = [&] {
            return glm::dvec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
        };
        ConvexVolume volume;
        for (int i = 0; i < 5; ++i)
            volume.planes.push_back({glm::normalize(point() + glm::dvec3(1e-9)), random.uniform(-0.3, 1.5)});
        const std::array<glm::dvec3, 3> corners{point(), point(), point()};
        TriangleClipper clipper(volume);
        const std::vector<glm::dvec3> polygon = clipper.clipped(corners);
        Box box;
        for (const glm::dvec3& corner : polygon) {
            box.add(corner);
            for (const Plane& plane : volume.planes)
                EXPECT_GE(plane.signedDistance(corner), -1e-12);
        }
        cut += !polygon.empty() && polygon.size() > 3 ? 1 : 0;
        for (int sample = 0; sample < 20; ++sample) {
            const double u = random.unit();
            const double v = random.unit() * (1 - u);
            const glm::dvec3 inside = corners[0] * (1 - u - v) + corners[1] * u + corners[2] * v;
            if (!contains(volume, inside)) continue;
            ASSERT_FALSE(polygon.empty());
            EXPECT_LE(distance(box, inside), 1e-12);
        }
    }
    EXPECT_GT(cut, 100);
}

TEST(TriangleClipper, CornersOnAPlaneStay) {
    ConvexVolume volume;
    volume.planes.push_back({{0, 0, 1}, 0}); // z >= 0
    TriangleClipper clipper(volume);
    const glm::dvec3 a(0, 0, 0);
    const glm::dvec3 b(1, 0, 0);
    for (const double z : {-1.0, 0.0, 1.0}) {
        const glm::dvec3 c(0, 1, z);
        for (const auto& corners : {std::array{a, b, c}, std::array{c, a, b}, std::array{b, c, a}}) {
            std::size_t isThere = 0;
            for (const glm::dvec3& corner : clipper.clipped(corners)) {
                EXPECT_TRUE(corner == a || corner == b || corner == c) << corner.x << " " << corner.y;
                EXPECT_GE(corner.z, 0);
                isThere |= corner == a ? 1U : corner == b ? 2U : 4U;
            }
            EXPECT_EQ(isThere, z < 0 ? 3U : 7U);
        }
    }
}

} // namespace
} // namespace gnomon::lod
