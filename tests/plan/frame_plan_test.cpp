// What a plan says of itself: names, numbers, and why each effect is left out.
#include "core/angle.h"
#include "core/error.h"
#include "core/random.h"
#include "made_scene.h"
#include "plan/frame_plan.h"
#include "plan/plan_frame.h"
#include "plan/skipped_effect.h"

#include <gtest/gtest.h>

#include <functional>

namespace gnomon::plan {
namespace {

FramePlan planOf(const Quality& quality, std::uint64_t seed) {
    const MadeScene scene(seed);
    return planFrame(madeView(seed), quality, scene.facts(madeView(seed))).plan;
}

/// A view across which the light falls, so that every warp and face has something to gain.
View litFromTheSide() {
    View view = madeView(4);
    view.towardsLight = {0.2, 1, 0.1};
    return view;
}

/// Of that view with receivers at every depth.
FramePlan planOf(const Quality& quality) {
    SceneFacts facts = MadeScene(4).facts(litFromTheSide());
    facts.light->lit = {{facts.visible->nearest, facts.visible->farthest}};
    return planFrame(litFromTheSide(), quality, facts).plan;
}

std::vector<SkippedEffect> skippedEffects(const FramePlan& plan, Effect effect) {
    std::vector<SkippedEffect> found;
    std::copy_if(
        plan.omitted.begin(), plan.omitted.end(), std::back_inserter(found), [&](const SkippedEffect& skipped) {
            return skipped.effect == effect;
        });
    return found;
}

TEST(FramePlanNames, SayTheScheme) {
    struct Row {
        std::function<void(Quality&)> with;
        const char* name;
    };

    const auto none = shadow::WarpRule::None;
    const std::vector<Row> table{
        {[](Quality& q) { q.shadows = ShadowMode::Off; }, "off"},
        {[](Quality& q) { q.shadows = ShadowMode::Rays; }, "rays"},
        {[&](Quality& q) { q.zPartitions = 1, q.warp.rule = none; }, "map"},
        {[&](Quality& q) { q.zPartitions = 1; }, "map+w"},
        {[&](Quality& q) { q.zPartitions = 3, q.warp.rule = none; }, "zp3"},
        {[&](Quality& q) { q.zPartitions = 4; }, "zp4+w"},
        {[&](Quality& q) { q.zPartitions = 1, q.facePartitions = Choice::On, q.warp.rule = none; }, "fp"},
        {[&](Quality& q) { q.zPartitions = 2, q.facePartitions = Choice::On; }, "fp+zp2+w"},
        {[&](Quality& q) { q.stabilize = true; }, "zp4"},
    };
    for (const Row& row : table) {
        Quality quality;
        row.with(quality);
        EXPECT_EQ(schemeName(planOf(quality)), row.name);
    }
    SceneFacts nothing;
    nothing.visible = SceneFacts::Visible();
    EXPECT_EQ(schemeName(planFrame({}, {}, nothing).plan), "none");
}

TEST(FramePlanNames, SayTheWarpRule) {
    using shadow::WarpRule;
    const std::vector<std::pair<WarpRule, const char*>> table{
        {WarpRule::None, "none"},
        {WarpRule::Psm, "psm"},
        {WarpRule::Lspsm, "lspsm"},
        {WarpRule::Tsm, "tsm"},
        {WarpRule::Minimax, "minimax"},
        {WarpRule::Auto, "auto"},
        {WarpRule::MinStorage, "sopt"},
        {WarpRule::Eta, "eta"},
        {WarpRule::Given, "given"},
        {WarpRule::Log, "log"}};
    for (const auto& [rule, name] : table)
        EXPECT_EQ(shadow::name(rule), name);
}

TEST(FramePlanReasons, ForNoMapsAtAll) {
    SceneFacts lit;
    lit.visible = {1, 100, true};
    lit.light = SceneFacts::Light();
    lit.light->lit = {{1, 100}};
    SceneFacts dark = lit;
    dark.light->lit.clear();
    SceneFacts open = lit;
    open.light->canBeShadowed = false;
    SceneFacts nothing;
    nothing.visible = SceneFacts::Visible();

    struct Row {
        ShadowMode shadows;
        SceneFacts facts;
        SkipReason reason;
    };

    const std::vector<Row> table{
        {ShadowMode::Off, lit, SkipReason::SwitchedOff},
        {ShadowMode::Rays, lit, SkipReason::RayTraced},
        {ShadowMode::Maps, nothing, SkipReason::NothingInView},
        {ShadowMode::Maps, dark, SkipReason::NothingFacesLight},
        {ShadowMode::Maps, open, SkipReason::NoCasterInReach}};
    for (const Row& row : table) {
        Quality quality;
        quality.shadows = row.shadows;
        const FramePlan plan = planFrame({}, quality, row.facts).plan;
        EXPECT_EQ(
            plan.omitted,
            (std::vector<SkippedEffect>{
                {Effect::ShadowMaps, row.reason}, {Effect::OcclusionCulling, SkipReason::BackendDrawsAll}}));
        EXPECT_TRUE(plan.passes.empty());
        EXPECT_EQ(plan.cost, 0U);
        EXPECT_EQ(plan.textureWidth + plan.textureHeight, 0);
    }
    EXPECT_TRUE(skippedEffects(planFrame({}, {}, lit).plan, Effect::ShadowMaps).empty());
}

TEST(FramePlanReasons, AreThoseOfTheQuality) {
    using Reason = SkipReason;

    struct Row {
        std::function<void(Quality&)> with;
        Effect effect;
        std::optional<SkipReason> reason; // nothing: it is not left out
    };

    const auto plain = [](Quality&) {};
    const auto stable = [](Quality& q) { q.stabilize = true, q.facePartitions = Choice::Auto; };
    const auto faces = [](Quality& q) { q.facePartitions = Choice::On; };
    const auto one = [](Quality& q) { q.zPartitions = 1; };
    const auto easy = [](Quality& q) { q.zPartitions.reset(), q.maxAliasing = 60, q.facePartitions = Choice::Auto; };
    const auto unwarped = [](Quality& q) { q.warp.rule = shadow::WarpRule::None; };
    const auto filtered = [](Quality& q) { q.filter = 3, q.cullCasters = CasterCulling::Off; };
    const std::vector<Row> table{
        {plain, Effect::FacePartitions, Reason::SwitchedOff},
        {plain, Effect::ZPartitions, {}},
        {plain, Effect::Warp, {}},
        {plain, Effect::Stabilization, Reason::SwitchedOff},
        {plain, Effect::MapReuse, Reason::NotStabilized},
        {plain, Effect::Filter, Reason::SwitchedOff},
        {plain, Effect::PartitionCulling, {}},
        {stable, Effect::FacePartitions, Reason::SlicesStabilized},
        {stable, Effect::Warp, Reason::SlicesStabilized},
        {stable, Effect::Orientation, Reason::SlicesStabilized},
        {stable, Effect::Stabilization, {}},
        {stable, Effect::MapReuse, {}},
        {faces, Effect::FacePartitions, {}},
        {faces, Effect::Orientation, Reason::FacesGiveIt},
        {one, Effect::ZPartitions, Reason::SwitchedOff},
        {easy, Effect::ZPartitions, Reason::OneSliceSuffices},
        {easy, Effect::FacePartitions, Reason::BetterWithout},
        {unwarped, Effect::Warp, Reason::SwitchedOff},
        {filtered, Effect::Filter, {}},
        {filtered, Effect::PartitionCulling, Reason::SwitchedOff},
    };
    for (std::size_t i = 0; i < table.size(); ++i) {
        SCOPED_TRACE(i);
        Quality quality;
        table[i].with(quality);
        const std::vector<SkippedEffect> found = skippedEffects(planOf(quality), table[i].effect);
        ASSERT_EQ(found.size(), table[i].reason ? 1U : 0U);
        if (!table[i].reason) continue;
        EXPECT_EQ(found[0].reason, *table[i].reason);
    }
}

TEST(FramePlanReasons, NameEachSliceThatGoesWithoutAMap) {
    SceneFacts facts;
    facts.visible = {1, 100, true};
    facts.light = SceneFacts::Light();
    facts.light->lit = {{1, 3}, {12, 13}};
    const FramePlan plan = planFrame(madeView(2), {}, facts).plan;
    const std::vector<SkippedEffect> expected{
        {Effect::MapOfSlice, SkipReason::NothingFacesLight, 1}, {Effect::MapOfSlice, SkipReason::NothingFacesLight, 3}};
    EXPECT_EQ(skippedEffects(plan, Effect::MapOfSlice), expected);
    EXPECT_EQ(plan.passOfPartition, (std::vector<int>{0, -1, 1, -1}));
    ASSERT_EQ(plan.passes.size(), 2U);
    EXPECT_EQ(plan.passes[0].map.region.slice, 0U);
    EXPECT_EQ(plan.passes[1].map.region.slice, 2U);
}

TEST(FramePlanReasons, GiveTheGainThatWasTooSmall) {
    int small = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Quality quality;
        quality.facePartitions = Choice::Auto;
        for (const SkippedEffect& skipped : planOf(quality, seed).omitted) {
            if (skipped.reason != SkipReason::GainTooSmall) continue;
            ++small;
            EXPECT_GE(skipped.gain, 0) << seed;
            EXPECT_LT(skipped.gain, 0.05) << seed;
        }
    }
    EXPECT_GT(small, 5);
}

TEST(FramePlanNumbers, AreThoseOfItsPasses) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        Quality quality;
        quality.facePartitions = seed % 3 == 0 ? Choice::On : Choice::Off;
        quality.filter = seed % 4 == 0 ? 3 : 0;
        const FramePlan plan = planOf(quality, seed);
        std::uint64_t triangles = 0;
        double storage = 0;
        shadow::Aliasing worst;
        for (const ShadowPass& pass : plan.passes) {
            const shadow::TexelRectangle inner = pass.map.innerRectangle();
            triangles += pass.estimatedTriangles;
            worst = {std::max(worst.x, pass.map.aliasingBound.x), std::max(worst.z, pass.map.aliasingBound.z)};
            storage += pass.map.aliasingBound.x * pass.map.aliasingBound.z * static_cast<double>(inner.area()) /
                       (static_cast<double>(plan.view.height) * plan.view.height);
            EXPECT_LE(pass.map.rectangle.x + pass.map.rectangle.width, plan.textureWidth);
            EXPECT_LE(pass.map.rectangle.y + pass.map.rectangle.height, plan.textureHeight);
        }
        const auto texels =
            static_cast<std::uint64_t>(plan.textureWidth) * static_cast<std::uint64_t>(plan.textureHeight);
        EXPECT_EQ(plan.cost, triangles + texels / 16);
        EXPECT_LE(texels, std::uint64_t{2048} * 2048);
        EXPECT_NEAR(plan.storageFactor, storage, 1e-9 * storage);
        EXPECT_EQ(plan.aliasingBound.x, worst.x);
        EXPECT_EQ(plan.aliasingBound.z, worst.z);
        EXPECT_TRUE(plan.isBoundKept) << "a number of slices that is asked for promises nothing";
        const glm::dvec3 light = plan.view.light().unit();
        const glm::dvec3 ahead = glm::normalize(plan.view.camera.target - plan.view.camera.eye);
        EXPECT_NEAR(std::cos(plan.lightAngleRadians), glm::dot(light, ahead), 1e-12);
    }
}

// Some of these lights lie halfway between two integers: rounded once more in the camera's space and back they would
// fall to either side as the camera turns.
TEST(FramePlan, LightIsRoundedOnceWhateverTheCamera) {
    Random random(11);
    constexpr double kLargest = (1 << kLightBits) - 1;
    for (int i = 0; i < 300; ++i) {
        View view = madeView(4);
        const auto half = static_cast<double>(random.below(1 << kLightBits)) - 0.5;
        view.towardsLight = {half, kLargest, i % 2 == 0 ? 0.5 : random.uniform(-1, 1)};
        const IntegerLight light = roundedLight(view.towardsLight);
        view.camera.target = view.camera.eye + glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), 1);
        const SceneFacts facts = MadeScene(4).facts(view);
        for (const ShadowMode mode : {ShadowMode::Exact, ShadowMode::Maps, ShadowMode::Rays}) {
            Quality quality;
            quality.shadows = mode;
            const FramePlan plan = planFrame(view, quality, facts).plan;
            EXPECT_EQ(plan.light, light);
            EXPECT_LT(glm::distance(toWorld(plan.basis, plan.towardsLight), light.unit()), 1e-14) << "maps, shading";
        }
    }
}

TEST(FramePlanErrors, NameAQuantityAndNoOption) {
    struct Row {
        const char* names;
        std::function<void(View&)> spoil;
    };

    const std::vector<Row> table{
        {"image size", [](View& view) { view.width = 0; }},
        {"image size", [](View& view) { view.height = -1; }},
        {"vertical angle", [](View& view) { view.camera.fovYRadians = 0; }},
        {"vertical angle", [](View& view) { view.camera.fovYRadians = 3.2; }},
        {"vertical angle", [](View& view) { view.camera.fovYRadians = radiansFromDegrees(180); }},
        {"vertical angle", [](View& view) { view.camera.fovYRadians = 3.2; }},
        {"light", [](View& view) { view.towardsLight = glm::dvec3(0); }},
        {"light", [](View& view) { view.towardsLight.x = std::numeric_limits<double>::infinity(); }}};
    for (const Row& row : table) {
        View view;
        row.spoil(view);
        try {
            planFrame(view, {}, {});
            ADD_FAILURE() << row.names;
        } catch (const Error& error) {
            const std::string text = error.what();
            EXPECT_NE(text.find(row.names), std::string::npos) << text;
            EXPECT_EQ(text.find("--"), std::string::npos) << text;
        }
    }
}

} // namespace
} // namespace gnomon::plan
