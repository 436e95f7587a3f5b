// What light could reach and where casters are, against every triangle and every cluster looked at.
#include "lod/lit_side.h"
#include "lod/triangle_clip.h"
#include "lod/visible_depths.h"
#include "seen_scene.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>

namespace gnomon::lod {
namespace {

using tests::sharedModel;

glm::dvec3 randomLight(Random& random) {
    return glm::normalize(
        glm::dvec3(random.uniform(-1, 1), random.uniform(-0.2, 1), random.uniform(-1, 1)) + glm::dvec3(1e-9));
}

/// The depths of every lit triangle that is seen, each with whether casters reach above its plane.
struct LitTriangle {
    DepthSpan depths;
    bool canBeShadowed = false;
};

/// Whether a corner of `casters` lies above the plane through `point` by more than a step of the grid.
bool reachAbove(const Box& casters, const glm::dvec3& point, const glm::dvec3& normal) {
    const double step = sharedModel().trees.grid().step();
    for (unsigned corner = 0; corner < 8 && !casters.isEmpty(); ++corner) {
        const glm::dvec3 p(
            (corner & 1U) != 0 ? casters.max.x : casters.min.x,
            (corner & 2U) != 0 ? casters.max.y : casters.min.y,
            (corner & 4U) != 0 ? casters.max.z : casters.min.z);
        if (glm::dot(glm::normalize(normal), p - point) > step) return true;
    }
    return false;
}

std::vector<LitTriangle> litTriangles(const Seen& scene, const glm::dvec3& towardsLight, const Box& casters) {
    std::vector<LitTriangle> found;
    TriangleClipper clipper(scene.volumes[0]);
    forEveryTriangle(scene.query(), scene.cut.lists.image, [&](const auto& corners, const auto&, const auto&) {
        glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (glm::dot(normal, scene.view.eye - corners[0]) < 0) normal = -normal; // the seen side
        if (!(glm::dot(normal, towardsLight) > 0)) return;
        LitTriangle lit{{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}, false};
        for (const glm::dvec3& point : clipper.clipped(corners)) {
            const double depth = glm::dot(scene.view.basis.view, point - scene.view.eye);
            lit.depths = {std::min(lit.depths.near, depth), std::max(lit.depths.far, depth)};
        }
        if (lit.depths.near > lit.depths.far) return;
        lit.canBeShadowed = reachAbove(casters, corners[0], normal);
        found.push_back(lit);
    });
    return found;
}

bool isWithin(const std::vector<DepthSpan>& spans, double depth) {
    return std::any_of(spans.begin(), spans.end(), [&](const DepthSpan& span) {
        return depth >= span.near * (1 - 1e-12) && depth <= span.far * (1 + 1e-12);
    });
}

const double kStep = std::exp2(1.0 / kSpansPerOctave);

/// Spans in order, within `depths`, none of which reaches further than its triangles by more than a step.
void checkSpans(
    const std::vector<DepthSpan>& spans, const std::vector<LitTriangle>& expected, const DepthSpan& depths) {
    const auto reaches = [&](double from, double to) {
        return std::any_of(expected.begin(), expected.end(), [&](const LitTriangle& triangle) {
            return std::clamp(triangle.depths.near, depths.near, depths.far) <= to &&
                   std::clamp(triangle.depths.far, depths.near, depths.far) >= from;
        });
    };
    double last = 0;
    for (const DepthSpan& span : spans) {
        EXPECT_LT(span.near, span.far);
        EXPECT_GE(span.near, depths.near);
        EXPECT_LE(span.far, depths.far);
        EXPECT_GT(span.near, last) << "apart and in order";
        EXPECT_GT(span.near, last * (1 + 1e-9)) << "apart, not merely parted";
        last = span.far;
        EXPECT_TRUE(reaches(span.near / (1 + 1e-9), span.near * kStep * (1 + 1e-9))) << "one step at most too far";
        EXPECT_TRUE(reaches(span.far / kStep / (1 + 1e-9), span.far * (1 + 1e-9)));
    }
}

TEST(LitSurfaces, SpansHoldWhatIsLitAndReachOneStepFurtherAtMost) {
    Random random(71);
    int lit = 0;
    int shadowed = 0;
    for (int trial = 0; trial < 80; ++trial) {
        const Seen scene(random);
        const glm::dvec3 light = randomLight(random);
        const Box casters = trial % 5 == 0 ? Box{} : sharedModel().bounds;
        const double nearest = trial % 2 == 0 ? 1 : 16; // before all that is seen, or in its midst
        const DepthSpan depths{nearest * random.uniform(0.01, 1), random.uniform(20, 400)};
        const LitSurfaces found = litSurfaces(scene.query(), scene.cut.lists.image, light, casters, depths);
        const std::vector<LitTriangle> expected = litTriangles(scene, light, casters);
        bool canBeShadowed = false;
        for (const LitTriangle& triangle : expected) {
            canBeShadowed = canBeShadowed || triangle.canBeShadowed;
            EXPECT_TRUE(isWithin(found.spans, std::clamp(triangle.depths.near, depths.near, depths.far)));
            EXPECT_TRUE(isWithin(found.spans, std::clamp(triangle.depths.far, depths.near, depths.far)));
        }
        checkSpans(found.spans, expected, depths);
        EXPECT_EQ(found.canBeShadowed, canBeShadowed);
        lit += expected.empty() ? 0 : 1;
        shadowed += canBeShadowed ? 1 : 0;
    }
    EXPECT_GT(lit, 30);
    EXPECT_GT(shadowed, 20);
    EXPECT_LT(shadowed, lit);
}

// Beside every triangle looked at: what is sure to be dark is, and what is lit is found.
TEST(LitSide, IsFoundWhereAnyTriangleShowsIt) {
    Random random(74);
    int dark = 0;
    for (int trial = 0; trial < 150; ++trial) {
        const Seen scene(random);
        // Mostly against the view, where all that is seen may be turned from the light.
        const glm::dvec3 light =
            trial % 3 == 0 ? randomLight(random) : glm::normalize(scene.view.basis.view + 0.02 * randomLight(random));
        const bool isLit = !litTriangles(scene, light, {}).empty();
        const bool mayBe = mayFaceLight(scene.query(), scene.cut.lists.image, light);
        EXPECT_TRUE(mayBe || !isLit) << trial;
        dark += mayBe ? 0 : 1;
    }
    EXPECT_GT(dark, 5);
    EXPECT_LT(dark, 145);
}

TEST(VisibleSlabs, StepsAreSixteenAnOctaveAndLieInTheRange) {
    Random random(73);
    for (int trial = 0; trial < 30; ++trial) {
        const Seen scene(random);
        const DepthSpan depths{random.uniform(0.01, 1), random.uniform(20, 400)};
        const std::vector<shadow::VisibleSlab> parts = visibleSlabs(scene.query(), scene.cut.lists.image, depths);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const DepthSpan& span = parts[i].depths;
            EXPECT_GE(span.near, depths.near * (1 - 1e-12));
            EXPECT_LE(span.far, depths.far * (1 + 1e-12));
            const double step = std::log2(span.near / depths.near) * kSpansPerOctave;
            EXPECT_NEAR(step, std::round(step), 1e-9) << "whole steps from the nearest";
            EXPECT_LE(span.far, span.near * kStep * (1 + 1e-12));
            if (i > 0) {
                EXPECT_GE(span.near, parts[i - 1].depths.far * (1 - 1e-12));
            }
            EXPECT_FALSE(parts[i].box.isEmpty());
        }
    }
}

TEST(VisibleSlabs, AreTheSameForAnyNumberOfThreads) {
    Random random(75);
    std::size_t compared = 0;
    for (int trial = 0; trial < 20; ++trial) {
        const Seen scene(random);
        const DepthSpan depths{random.uniform(0.01, 1), random.uniform(20, 400)};
        const auto partsOn = [&](int threads) {
            return tbb::task_arena(threads).execute(
                [&] { return visibleSlabs(scene.query(), scene.cut.lists.image, depths); });
        };
        const std::vector<shadow::VisibleSlab> one = partsOn(1);
        for (const int threads : {2, 16}) {
            const std::vector<shadow::VisibleSlab> parts = partsOn(threads);
            ASSERT_EQ(parts.size(), one.size());
            for (std::size_t i = 0; i < parts.size(); ++i) {
                EXPECT_EQ(parts[i].depths.near, one[i].depths.near);
                EXPECT_EQ(parts[i].depths.far, one[i].depths.far);
                EXPECT_EQ(parts[i].box.min, one[i].box.min);
                EXPECT_EQ(parts[i].box.max, one[i].box.max);
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 100U);
}

/// The box of a cluster with what any refinement may move it by.
Box grown(const hierarchy::Page& page, const hierarchy::Cluster& cluster) {
    const Box box = sharedModel().trees.grid().local(cluster.box);
    const double margin = cluster.refinement == hierarchy::kNone ? 0 : page.refinements[cluster.refinement].error;
    return {box.min - margin, box.max + margin};
}

/// What the blocks of one range must be.
std::vector<CasterBlock> blocksOf(const hierarchy::Page& page, const lod::ClusterRange& range) {
    std::vector<CasterBlock> blocks;
    for (std::uint32_t i = 0; i < range.clusterCount; ++i) {
        if (i % kClustersPerBlock == 0) blocks.emplace_back();
        const hierarchy::Cluster& cluster = page.clusters[range.firstCluster + i];
        blocks.back().box.add(grown(page, cluster));
        blocks.back().triangles += cluster.triangleCount;
    }
    return blocks;
}

TEST(CasterBlocks, AreRunsOfSixteenClustersInTheListsOrder) {
    Random random(74);
    for (int trial = 0; trial < 30; ++trial) {
        const Seen scene(random);
        const lod::DrawList& list = scene.cut.lists.image;
        const std::vector<CasterBlock> blocks = casterBlocks(scene.query(), list);
        std::size_t next = 0;
        std::uint64_t triangles = 0;
        for (const lod::ClusterRange& range : list.ranges)
            for (const CasterBlock& expected : blocksOf(*scene.resident[range.page], range)) {
                ASSERT_LT(next, blocks.size());
                EXPECT_EQ(blocks[next].box.min, expected.box.min);
                EXPECT_EQ(blocks[next].box.max, expected.box.max);
                EXPECT_EQ(blocks[next].triangles, expected.triangles);
                triangles += blocks[next++].triangles;
            }
        EXPECT_EQ(next, blocks.size());
        EXPECT_EQ(triangles, list.triangles) << "every triangle is in one block";
    }
}

} // namespace
} // namespace gnomon::lod
