// The plan that `--z-partitions auto` comes to, against working out every plan and taking the best; and how steady it
// is from frame to frame.
#include "made_scene.h"
#include "plan/hysteresis.h"
#include "plan/scheme_choice.h"
#include "tests/support/sanitizers.h"

#include <gtest/gtest.h>

namespace gnomon::plan {
namespace {

/// One scheme as the slow way sees it.
struct Tally {
    SchemeChoice choice;
    double bound = 0;
    std::uint64_t cost = 0;
    std::uint64_t required = 0;
    std::uint64_t texels = 0;
    std::size_t maps = 0;
};

bool touches(const ConvexVolume& volume, const CameraBasis& basis, const Box& box) {
    for (const Plane& plane : volume.planes) {
        bool isOut = true;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 point(
                (corner & 1) != 0 ? box.max.x : box.min.x,
                (corner & 2) != 0 ? box.max.y : box.min.y,
                (corner & 4) != 0 ? box.max.z : box.min.z);
            isOut = isOut && plane.signedDistance(toCamera(basis, point)) < -1e-9;
        }
        if (isOut) return false;
    }
    return true;
}

SchemeContext contextOf(const FramePlan& plan, const SceneFacts& facts) {
    SchemeContext context;
    context.view.frustum = {plan.near, plan.far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
    context.view.towardsLight = plan.towardsLight;
    context.view.imageHeight = plan.view.height;
    context.view.anchor = {plan.basis, plan.view.camera.eye};
    context.basis = plan.basis;
    context.quality = plan.quality;
    context.scene = &facts;
    context.backend = plan.backend;
    return context;
}

/// `slices` and `faces` worked out with the least quantised step of texels that keeps the promise, found by trying them
/// all; the whole budget if none does.
Tally tallied(const SchemeContext& context, int slices, bool faces, bool logRows) {
    SchemeContext given = context;
    given.quality.zPartitions = slices;
    const std::uint64_t budget = static_cast<std::uint64_t>(context.quality.shadowTexelsWidth) *
                                 static_cast<std::uint64_t>(context.quality.shadowTexelsHeight);
    const SchemeCandidate whole = evaluate(given, {slices, faces, true, logRows});
    Tally result{
        {slices, faces, true, logRows},
        whole.aliasingBound(),
        0,
        whole.requiredTexels,
        budget,
        whole.setup.maps.size()};
    shadow::ShadowMapSetup setup = whole.setup;
    if (whole.requiredTexels > 0 && whole.requiredTexels <= budget) {
        std::uint64_t step = budget;
        for (int i = 0; i < 200; ++i) {
            const auto next = static_cast<std::uint64_t>(std::ceil(std::exp2(i / 4.0)));
            if (next >= whole.requiredTexels && next < step) step = next;
        }
        shadow::ShadowOptions options = whole.options;
        options.texels = step;
        setup = shadow::shadowMapSetup(context.view, options);
        result.texels = step;
        result.bound = setup.worst().worst();
    }
    result.cost = static_cast<std::uint64_t>(setup.textureWidth) * static_cast<std::uint64_t>(setup.textureHeight) / 16;
    for (const shadow::ShadowMap& map : setup.maps) {
        std::uint64_t triangles = 0;
        for (const SceneFacts::CasterBlock& block : context.scene->light->casters)
            if (touches(map.casterVolume, context.basis, block.box)) triangles += block.triangles;
        result.cost += shadow::hasLogRows(map.warped) ? triangles * 3 / 2 : triangles;
    }
    return result;
}

/// Every scheme of even rows, and of logarithmic ones those of one slice where they can be drawn.
std::vector<SchemeChoice> choicesOf(const SchemeContext& context) {
    std::vector<SchemeChoice> choices;
    for (int slices = 1; slices <= kMaxSlices; ++slices)
        for (const bool faces : {false, true}) {
            if (faces && context.quality.facePartitions != Choice::Auto) continue;
            choices.push_back({slices, faces, true, false});
            if (slices == 1 && context.backend.unevenRows) choices.push_back({slices, faces, true, true});
        }
    return choices;
}

/// What the words of the promise ask for, tried one after the other.
Tally bestOfAll(const SchemeContext& context) {
    std::optional<Tally> cheapest;
    std::optional<Tally> lowest;
    const double maxAliasing = context.quality.maxAliasing;
    const auto asked = [](const Tally& one) {
        return one.bound / (one.choice.faces ? 0.95 : 1) / (one.choice.logRows ? 0.95 : 1);
    };
    for (const SchemeChoice& choice : choicesOf(context)) {
        const Tally candidate = tallied(context, choice.slices, choice.faces, choice.logRows);
        if (candidate.bound <= maxAliasing && (!cheapest || candidate.cost < cheapest->cost)) cheapest = candidate;
        if (!lowest || asked(candidate) < asked(*lowest)) lowest = candidate;
    }
    return cheapest ? *cheapest : *lowest;
}

Quality autoQuality(std::uint64_t seed) {
    Random random(seed * 7 + 1);
    Quality quality;
    quality.zPartitions.reset();
    quality.maxAliasing = std::exp(random.uniform(-0.5, 2.5));
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 512 << random.below(3);
    quality.facePartitions = random.below(4) == 0 ? Choice::Auto : Choice::Off;
    return quality;
}

struct Outcome {
    int planned = 0;
    int kept = 0;
    int several = 0;
    int logRows = 0;
};

void expectTheBest(std::uint64_t first, std::uint64_t count, Outcome& outcome) {
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        SCOPED_TRACE(seed);
        const MadeScene scene(seed % 20);
        const View view = madeView(seed);
        const SceneFacts facts = scene.facts(view);
        const auto [plan, memory] = planFrame(view, autoQuality(seed), facts, {}, {.unevenRows = seed % 3 != 0});
        if (plan.passes.empty()) continue;
        const Tally best = bestOfAll(contextOf(plan, facts));
        ASSERT_TRUE(memory.scheme);
        EXPECT_EQ(memory.scheme->choice.slices, best.choice.slices);
        EXPECT_EQ(memory.scheme->choice.faces, best.choice.faces);
        EXPECT_EQ(memory.scheme->choice.logRows, best.choice.logRows);
        EXPECT_EQ(plan.isBoundKept, best.bound <= plan.quality.maxAliasing);
        const std::uint64_t budget = static_cast<std::uint64_t>(plan.quality.shadowTexelsWidth) *
                                     static_cast<std::uint64_t>(plan.quality.shadowTexelsHeight);
        EXPECT_EQ(plan.isBoundKept, std::max(plan.aliasingBound.x, plan.aliasingBound.z) <= plan.quality.maxAliasing);
        EXPECT_EQ(plan.isBoundKept, plan.requiredTexels > 0 && plan.requiredTexels <= budget);
        ++outcome.planned;
        outcome.kept += plan.isBoundKept ? 1 : 0;
        outcome.several += plan.passes.size() > 1 ? 1 : 0;
        outcome.logRows += best.choice.logRows ? 1 : 0;
        EXPECT_TRUE(plan.backend.unevenRows || !best.choice.logRows);
    }
}

TEST(AutoPlan, IsTheBestOfAllPlans) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Outcome outcome;
    expectTheBest(0, 40, outcome);
    EXPECT_GT(outcome.planned, 30);
    EXPECT_GT(outcome.kept, 5);
    EXPECT_LT(outcome.kept, outcome.planned - 2);
    EXPECT_GT(outcome.several, 5);
    EXPECT_GT(outcome.logRows, 3);
    EXPECT_LT(outcome.logRows, outcome.planned - 15);
}

TEST(SlowAutoPlan, IsTheBestOfAllPlansOnAThousandViews) {
    Outcome outcome;
    expectTheBest(1000, 1000, outcome);
    EXPECT_GT(outcome.planned, 900);
}

TEST(AutoPlan, RequiredTexelsSuffice) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    int tried = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const MadeScene scene(seed % 20);
        const View view = madeView(seed);
        const SceneFacts facts = scene.facts(view);
        Quality quality = autoQuality(seed);
        quality.facePartitions = Choice::Off;
        quality.maxAliasing /= 4;
        const FramePlan without = planFrame(view, quality, facts).plan;
        if (without.isBoundKept || without.requiredTexels == 0) continue;
        if (without.requiredTexels > (std::uint64_t{1} << 26U)) continue;
        quality.shadowTexelsWidth = static_cast<int>(without.requiredTexels);
        quality.shadowTexelsHeight = 1;
        EXPECT_TRUE(planFrame(view, quality, facts).plan.isBoundKept) << seed;
        ++tried;
    }
    EXPECT_GT(tried, 5);
}

/// How often the number of maps changes from frame to frame.
struct Changes {
    int all = 0;
    int unforced = 0; // less those that draw none because nothing is lit, or keep a promise that would be broken
};

bool wouldBreakItsBound(const PlanMemory& previous, const FramePlan& plan, const SceneFacts& facts) {
    SchemeContext context = contextOf(plan, facts);
    context.before = previous.scheme;
    context.receivers = receiversOf(context);
    return plan.isBoundKept && !evaluate(context, previous.scheme->choice).isWithinMaxAliasing;
}

/// While the camera turns by ten degrees in 200 frames.
Changes changesInASlowTurn(std::uint64_t seed) {
    const MadeScene scene(seed);
    View view = madeView(seed);
    const glm::dvec3 ahead = view.camera.target - view.camera.eye;
    Quality quality = autoQuality(seed);
    quality.facePartitions = Choice::Off;
    PlannedFrame previous;
    Changes changes;
    for (int frame = 0; frame < 200; ++frame) {
        const double yaw = frame / 200.0 * 10 * 0.017453292519943295;
        const double across = std::cos(yaw) * ahead.x + std::sin(yaw) * ahead.z;
        const double along = std::cos(yaw) * ahead.z - std::sin(yaw) * ahead.x;
        view.camera.target = view.camera.eye + glm::dvec3(across, ahead.y, along);
        const SceneFacts facts = scene.facts(view);
        PlannedFrame now = planFrame(view, quality, facts, previous.memory);
        if (frame > 0 && previous.plan.passes.size() != now.plan.passes.size()) {
            ++changes.all;
            const bool isDark = previous.plan.passes.empty() || now.plan.passes.empty();
            if (!isDark && !wouldBreakItsBound(previous.memory, now.plan, facts)) ++changes.unforced;
        }
        previous = std::move(now);
    }
    return changes;
}

TEST(AutoPlan, HoldsTheNumberOfMapsInASlowTurn) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    for (const std::uint64_t seed : {3U, 33U, 101U, 206U})
        EXPECT_LE(changesInASlowTurn(seed).all, 2) << seed;
}

TEST(SlowAutoPlan, HoldsTheNumberOfMapsInSlowTurns) {
    constexpr int kTurns = 300;
    int flickers = 0;
    for (std::uint64_t seed = 0; seed < kTurns; ++seed) {
        const Changes changes = changesInASlowTurn(seed);
        EXPECT_LE(changes.unforced, 2) << seed;
        EXPECT_LE(changes.all, 4) << seed;
        flickers += changes.all > 2 ? 1 : 0;
    }
    EXPECT_LE(flickers, kTurns / 100) << "what other bars ask for is rare";
}

TEST(FramePlan, IsTheSameForTheSameArguments) {
    const MadeScene scene(1);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const View view = madeView(seed);
        const FramePlan a = planFrame(view, autoQuality(seed), scene.facts(view)).plan;
        const FramePlan b = planFrame(view, autoQuality(seed), scene.facts(view)).plan;
        ASSERT_EQ(a.passes.size(), b.passes.size());
        for (std::size_t i = 0; i < a.passes.size(); ++i)
            EXPECT_EQ(a.passes[i].map.lightClipFromCamera(), b.passes[i].map.lightClipFromCamera());
    }
}

TEST(FramePlan, DrawsNoMapFromTheFrameOnInWhichNothingFacesTheLight) {
    const View view = madeView(2);
    SceneFacts facts;
    facts.visible = {1, 100, true};
    facts.light = SceneFacts::Light();
    facts.light->lit = {{1, 100}};
    const PlannedFrame lit = planFrame(view, {}, facts);
    ASSERT_FALSE(lit.plan.passes.empty());
    facts.light->lit.clear();
    const FramePlan dark = planFrame(view, {}, facts, lit.memory).plan;
    EXPECT_TRUE(dark.passes.empty()) << "no map outlives all of them";
    ASSERT_FALSE(dark.omitted.empty());
    EXPECT_EQ(dark.omitted.front().reason, SkipReason::NothingFacesLight);
}

SceneFacts litBetween(const std::vector<DepthSpan>& lit) {
    SceneFacts facts;
    facts.visible = {1, 100, true};
    facts.light = SceneFacts::Light();
    facts.light->lit = lit;
    return facts;
}

TEST(FramePlan, AMapOutlivesItsReceiversByAFewFrames) {
    const View view = madeView(2);
    const SceneFacts all = litBetween({{1, 100}});
    const SceneFacts gap = litBetween({{1, 3}, {12, 100}}); // nothing in the second slice, from 3.2 to 10
    PlannedFrame planned = planFrame(view, {}, all);
    EXPECT_EQ(planned.plan.passes.size(), 4U);
    EXPECT_EQ(planFrame(view, {}, gap).plan.passes.size(), 3U);
    int frames = 0;
    for (; planned.plan.passes.size() == 4 && frames < 300; ++frames)
        planned = planFrame(view, {}, gap, planned.memory);
    EXPECT_EQ(planned.plan.passes.size(), 3U);
    EXPECT_GE(frames, kFramesBeforeMapsGo);
    EXPECT_LE(frames, 2 * kFramesBeforeMapsGo);
    EXPECT_EQ(planFrame(view, {}, all, planned.memory).plan.passes.size(), 4U)
        << "a receiver is not to wait for its map";
}

TEST(FramePlan, MapsGoTogetherAndComeTogether) {
    const View view = madeView(2);
    PlannedFrame planned = planFrame(view, {}, litBetween({{1, 100}}));
    std::vector<std::size_t> maps{4};
    // The third slice (10 to 32) empties twenty frames after the second.
    for (int frame = 0; frame < 3 * kFramesBeforeMapsGo; ++frame) {
        const SceneFacts facts = frame < 20 ? litBetween({{1, 3}, {12, 100}}) : litBetween({{1, 3}, {40, 100}});
        planned = planFrame(view, {}, facts, planned.memory);
        if (planned.plan.passes.size() != maps.back()) maps.push_back(planned.plan.passes.size());
    }
    EXPECT_EQ(maps, (std::vector<std::size_t>{4, 2}));
    planned = planFrame(view, {}, litBetween({{1, 3}, {12, 13}, {40, 100}}), planned.memory);
    EXPECT_EQ(planned.plan.passes.size(), 4U) << "where one is needed the other is likely to be";
}

TEST(FramePlan, AReceiverThatComesAndGoesKeepsItsMap) {
    const View view = madeView(2);
    PlannedFrame planned = planFrame(view, {}, litBetween({{1, 100}}));
    for (int frame = 0; frame < 5 * kFramesBeforeMapsGo; ++frame) {
        const SceneFacts facts = frame % 40 == 0 ? litBetween({{1, 100}}) : litBetween({{1, 3}, {12, 100}});
        planned = planFrame(view, {}, facts, planned.memory);
        ASSERT_EQ(planned.plan.passes.size(), 4U) << frame;
    }
}

TEST(AutoPlan, AStillCameraComesToAPlanAsGoodAsAFirstFrames) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    for (std::uint64_t seed = 1; seed < 6; ++seed) {
        const MadeScene scene(seed);
        View view = madeView(seed);
        const Quality quality = autoQuality(seed);
        PlannedFrame planned = planFrame(view, quality, scene.facts(view));
        view.camera.target.x += 0.1;
        const SceneFacts facts = scene.facts(view);
        for (int frame = 0; frame < 4 * kFramesBeforeMapsGo; ++frame)
            planned = planFrame(view, quality, facts, planned.memory);
        const FramePlan& plan = planned.plan;
        const FramePlan first = planFrame(view, quality, facts).plan;
        ASSERT_EQ(plan.isBoundKept, first.isBoundKept) << seed;
        const auto worst = [](const FramePlan& p) { return std::max(p.aliasingBound.x, p.aliasingBound.z); };
        const bool isAsGood = plan.isBoundKept
                                  ? static_cast<double>(plan.cost) * kCheaper <= static_cast<double>(first.cost)
                                  : worst(plan) * kLower <= worst(first) / kWorthwhile;
        EXPECT_TRUE(isAsGood) << seed << ": " << plan.cost << " for " << first.cost << ", " << worst(plan) << " for "
                              << worst(first);
    }
}

} // namespace
} // namespace gnomon::plan
