// The passes of a plan: the maps of the setup as they are, which partition asks which, and which have casters before
// them.
#include "made_scene.h"
#include "plan/lamp/lamp_passes.h"
#include "plan/shadow_passes.h"

#include <gtest/gtest.h>

namespace gnomon::plan {
namespace {

/// A plan that wants its passes: a view down at a plain, the light overhead, surfaces from 10 to 40 units away.
FramePlan unplanned(Quality quality = {}) {
    FramePlan plan;
    plan.view.camera = {{0, 20, 0}, {0, 0, -20}, {0, 1, 0}, 0.6};
    plan.view.towardsLight = {0, 1, 0};
    plan.quality = quality;
    plan.basis = cameraBasis(plan.view.camera);
    plan.towardsLight = toCamera(plan.basis, plan.view.towardsLight);
    plan.near = 10;
    plan.far = 40;
    return plan;
}

/// A block of casters `above` units over the eye, or under it, in the middle of the view.
SceneFacts blockAt(double above) {
    SceneFacts facts;
    facts.visible = {10, 40, true};
    facts.light = SceneFacts::Light();
    facts.light->lit = {{10, 40}};
    facts.light->casters = {{{{-30, above, -50}, {30, above + 1, 10}}, 7}};
    return facts;
}

TEST(ShadowPasses, ClampDepthWhereACasterIsNearerToTheLightThanTheirMaps) {
    FramePlan high = unplanned();
    planShadowPasses(high, blockAt(200), std::nullopt);
    FramePlan low = unplanned();
    planShadowPasses(low, blockAt(-20), std::nullopt);
    FramePlan unknown = unplanned();
    planShadowPasses(unknown, {}, std::nullopt);
    ASSERT_FALSE(high.passes.empty());
    for (const ShadowPass& pass : high.passes) {
        EXPECT_TRUE(pass.clampsDepth);
        EXPECT_EQ(pass.estimatedTriangles, 7U);
        EXPECT_FALSE(pass.isReused);
    }
    for (const ShadowPass& pass : low.passes)
        EXPECT_FALSE(pass.clampsDepth) << "of slice " << pass.map.region.slice;
    for (const ShadowPass& pass : unknown.passes)
        EXPECT_TRUE(pass.clampsDepth) << "before the hierarchy was asked, anything may be anywhere";
}

TEST(ShadowPasses, AreAskedByThePartitionsThatTheyAreOf) {
    Quality quality;
    quality.facePartitions = Choice::On;
    FramePlan plan = unplanned(quality);
    const SchemeMemory memory = planShadowPasses(plan, blockAt(0), std::nullopt);
    ASSERT_EQ(plan.passOfPartition.size(), plan.selector.partitionCount());
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        const double depth = random.uniform(10, 40);
        const double reach = depth * plan.view.tanHalfY();
        const glm::dvec3 p(random.uniform(-reach, reach), random.uniform(-reach, reach), depth);
        const std::size_t partition = shadow::partitionIndex(plan.selector, p);
        const int pass = plan.passOfPartition[partition];
        ASSERT_GE(pass, 0);
        const shadow::Region& region = plan.passes[static_cast<std::size_t>(pass)].map.region;
        EXPECT_EQ(region.slice, partition / plan.selector.facesPerSlice());
        for (const Plane& plane : region.volume.planes)
            EXPECT_GE(plane.signedDistance(p), -2e-3 * plan.far) << shadow::name(region.face);
    }
    EXPECT_EQ(memory.maps, plan.passes.size());
    EXPECT_EQ(memory.choice.slices, 4);
    EXPECT_TRUE(memory.choice.faces);
    EXPECT_EQ(memory.framesDominated, 0);
    EXPECT_EQ(memory.emptySlices, 0U);
}

TEST(LampPasses, AreAMapForEachFaceOfTheCubeThatAnythingIsSeenThrough) {
    const MadeScene scene(3);
    int passes = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        View view = madeView(seed);
        Random random(seed);
        view.pointLight = {{random.uniform(-200, 200), random.uniform(0, 40), random.uniform(-200, 200)}, 10};
        SceneFacts facts = scene.facts(view);
        if (!facts.visible->anything) continue;
        for (const SceneFacts::CasterBlock& block : facts.light->casters)
            facts.light->seen.push_back({{facts.visible->nearest, facts.visible->farthest}, block.box});
        Quality quality;
        quality.shadows = ShadowMode::Maps;
        quality.cullCasters = seed % 2 == 0 ? CasterCulling::On : CasterCulling::Off;
        const FramePlan plan = planFrame(view, quality, facts, {}).plan;
        EXPECT_NEAR(glm::length(lampInCamera(view)), glm::length(view.pointLight->at - view.camera.eye), 1e-9);
        if (plan.passes.empty()) continue;
        passes += static_cast<int>(plan.passes.size());
        EXPECT_EQ(schemeName(plan), "cube");
        ASSERT_EQ(plan.passOfPartition.size(), 6U);
        for (std::size_t face = 0; face < 6; ++face) {
            const int pass = plan.passOfPartition[face];
            if (pass < 0) continue;
            EXPECT_EQ(plan.passes.at(static_cast<std::size_t>(pass)).map.region.face, shadow::kCubeFaces[face]);
        }
        std::uint64_t cost =
            static_cast<std::uint64_t>(plan.textureWidth) * static_cast<std::uint64_t>(plan.textureHeight) / 16;
        std::uint64_t all = 0;
        for (const SceneFacts::CasterBlock& block : facts.light->casters)
            all += block.triangles;
        for (const ShadowPass& pass : plan.passes) {
            EXPECT_LE(std::max(pass.map.aliasingBound.x, pass.map.aliasingBound.z), plan.aliasingBound.worst());
            EXPECT_EQ(pass.estimatedTriangles == all, quality.cullCasters == CasterCulling::Off) << seed;
            cost += pass.estimatedTriangles;
        }
        EXPECT_EQ(plan.cost, cost);
        const SkippedEffect noWarp{Effect::Warp, SkipReason::FacesOfCube};
        EXPECT_EQ(std::count(plan.omitted.begin(), plan.omitted.end(), noWarp), 1);
    }
    EXPECT_GT(passes, 40);
}

} // namespace
} // namespace gnomon::plan
