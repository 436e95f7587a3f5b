#include "core/random.h"
#include "plan/cell_maps.h"
#include "plan/plan_frame.h"

#include <gtest/gtest.h>

namespace gnomon::plan {
namespace {

/// Two points on one ray towards the light lie on the same place of a cell map, whatever the view: triangles and the
/// samples that they shadow meet in the same cells.
TEST(SampleGridMaps, HaveOnePlaceForEachRayTowardsTheLight) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const auto any = [&](double size) {
            return glm::dvec3(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
        };
        View view;
        view.camera = {any(10), any(10), {0, 1, 0}, random.uniform(0.2, 2.0)};
        view.towardsLight = any(1);
        Quality quality;
        quality.shadows = ShadowMode::Exact;
        quality.cellScheme = kCellSchemes.at(seed % kCellSchemes.size()).value;
        const bool isSliced =
            quality.cellScheme == CellScheme::Slices || quality.cellScheme == CellScheme::WarpedSlices;
        SceneFacts scene;
        scene.bounds.add(glm::dvec3(-50));
        scene.bounds.add(glm::dvec3(50));
        scene.visible = {random.uniform(0.1, 5), random.uniform(10, 90), true};
        const FramePlan plan = planFrame(view, quality, scene, {}).plan;
        EXPECT_TRUE(plan.passes.empty());
        ASSERT_EQ(plan.sampleGridMaps.size(), isSliced ? 4U : 1U) << seed;
        EXPECT_EQ(cellSide(plan), isSliced ? kCellSide / 2 : kCellSide);
        const shadow::ShadowMap& map = plan.sampleGridMaps[seed % plan.sampleGridMaps.size()];
        const glm::dmat4 clip = map.lightClipFromCamera();
        const double depth = random.uniform(map.region.frustum.near, map.region.frustum.far);
        const glm::dvec3 p(random.uniform(-0.2, 0.2) * depth, random.uniform(-0.2, 0.2) * depth, depth);
        const glm::dvec4 a = clip * glm::dvec4(p, 1);
        const glm::dvec4 b = clip * glm::dvec4(p + plan.towardsLight * random.uniform(0, 30), 1);
        EXPECT_GT(a.w, 0) << seed;
        EXPECT_NEAR(a.x / a.w, b.x / b.w, 1e-9) << seed;
        EXPECT_NEAR(a.y / a.w, b.y / b.w, 1e-9) << seed;
        EXPECT_NEAR(a.w, b.w, 1e-9 * a.w) << seed;
    }
}

} // namespace
} // namespace gnomon::plan
