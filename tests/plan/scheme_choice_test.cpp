// The choice between schemes: what is open, what it counts, and how ties are told apart.
#include "made_scene.h"
#include "plan/hysteresis.h"
#include "plan/scheme_choice.h"
#include "tests/support/sanitizers.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::plan {
namespace {

TEST(SchemeChoice, OpensWhatTheQualityLeavesOpen) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const auto open = [](std::optional<int> slices, Choice faces, bool stabilize, bool drawsLogRows = false) {
        SchemeContext context;
        context.backend.unevenRows = drawsLogRows;
        context.quality.zPartitions = slices;
        context.quality.facePartitions = faces;
        context.quality.stabilize = stabilize;
        return openChoices(context);
    };
    EXPECT_EQ(open(4, Choice::Off, false), (std::vector<SchemeChoice>{{4, false, true}}));
    EXPECT_EQ(open(4, Choice::On, false), (std::vector<SchemeChoice>{{4, true, true}}));
    EXPECT_EQ(open(4, Choice::Auto, false), (std::vector<SchemeChoice>{{4, false, true}, {4, true, true}}));
    EXPECT_EQ(open(4, Choice::On, true), (std::vector<SchemeChoice>{{4, false, true}}));
    const std::vector<SchemeChoice> all = open({}, Choice::Auto, false);
    ASSERT_EQ(all.size(), 2U * kMaxSlices);
    EXPECT_EQ(all.front(), (SchemeChoice{1, false, true}));
    EXPECT_EQ(all.back(), (SchemeChoice{kMaxSlices, true, true}));
    EXPECT_EQ(open(4, Choice::Auto, false, true), open(4, Choice::Auto, false)) << "slices that are given are even";
    EXPECT_EQ(open({}, Choice::Auto, true, true), open({}, Choice::Auto, true));
    const std::vector<SchemeChoice> withLog = open({}, Choice::Auto, false, true);
    EXPECT_EQ(withLog.size(), all.size() + 2);
    for (const bool faces : {false, true})
        EXPECT_EQ(std::count(withLog.begin(), withLog.end(), SchemeChoice{1, faces, true, true}), 1);
}

/// A candidate of one map with a promise and a cost.
SchemeCandidate candidate(bool isWithinMaxAliasing, double bound, std::uint64_t cost, bool faces = false) {
    SchemeCandidate result;
    result.choice.faces = faces;
    result.isWithinMaxAliasing = isWithinMaxAliasing;
    result.cost = cost;
    result.setup.maps.emplace_back().aliasingBound = {bound, bound / 2, bound};
    return result;
}

TEST(SchemeChoice, PrefersKeptPromisesThenCostsThenLowerPromises) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();

    struct Row {
        SchemeCandidate better;
        SchemeCandidate worse;
    };

    const std::vector<Row> table{
        {candidate(true, 9, 1000), candidate(false, 1, 1)},
        {candidate(true, 9, 1), candidate(true, 1, 2)},
        {candidate(false, 1, 1000), candidate(false, 2, 1)},
        {candidate(false, 0.96, 1), candidate(false, 0.95, 1, true)}, // faces have to be worth it
        {candidate(false, 0.94, 1, true), candidate(false, 1, 1)},
    };
    for (const Row& row : table) {
        EXPECT_TRUE(isBetter(row.better, row.worse));
        EXPECT_FALSE(isBetter(row.worse, row.better));
    }
    // Neither of two equals is better, so that of the fewest maps, which comes first, stays.
    EXPECT_FALSE(isBetter(candidate(true, 1, 5), candidate(true, 2, 5)));
    EXPECT_FALSE(isBetter(candidate(true, 2, 5), candidate(true, 1, 5)));
    EXPECT_FALSE(isBetter(candidate(false, 1, 5), candidate(false, 1, 4)));
    EXPECT_FALSE(isBetter(candidate(false, 1, 4), candidate(false, 1, 5)));
}

TEST(SchemeChoice, CountsTheTrianglesOfBlocksThatTouchAVolume) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const CameraBasis basis = cameraBasis({{0, 0, 0}, {1, 2, 3}, {0, 1, 0}, 1});
    ConvexVolume volume; // depths of 1 and more
    volume.planes.push_back({{0, 0, 1}, -1});
    const auto blockAt = [&](double depth, double half, std::uint64_t triangles) {
        const glm::dvec3 middle = toWorld(basis, {0, 0, depth});
        return SceneFacts::CasterBlock{{middle - half, middle + half}, triangles};
    };
    const std::vector<SceneFacts::CasterBlock> blocks{
        blockAt(5, 0.1, 1), blockAt(-5, 0.1, 10), blockAt(0.95, 0.1, 100), blockAt(0.5, 0.01, 1000)};
    EXPECT_EQ(trianglesIn(volume, basis, blocks), 101U);
    EXPECT_EQ(trianglesIn({}, basis, blocks), 1111U);
    EXPECT_EQ(trianglesIn(volume, basis, {}), 0U);
}

SchemeContext contextOf(const MadeScene& scene, const View& view, const SceneFacts& facts, const Quality& quality) {
    const FramePlan plan = planFrame(view, quality, scene.facts(view)).plan;
    SchemeContext context;
    context.view.frustum = {plan.near, plan.far, view.camera.fovYRadians / 2, view.aspect()};
    context.view.towardsLight = plan.towardsLight;
    context.view.imageHeight = view.height;
    context.view.anchor = {plan.basis, view.camera.eye};
    context.basis = plan.basis;
    context.quality = quality;
    context.scene = &facts;
    return context;
}

TEST(SchemeChoice, WithoutFactsOfTheLightTheTexelsAloneCost) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const MadeScene scene(2);
    const View view = madeView(2);
    SceneFacts facts = scene.facts(view);
    facts.light.reset();
    const SchemeCandidate found = evaluate(contextOf(scene, view, facts, {}), {4, false, true});
    const auto texels =
        static_cast<std::uint64_t>(found.setup.textureWidth) * static_cast<std::uint64_t>(found.setup.textureHeight);
    EXPECT_EQ(found.casterTriangles, std::vector<std::uint64_t>(4, 0));
    EXPECT_EQ(found.cost, texels / kTexelsPerTriangle);
}

TEST(SchemeChoice, KeepsTheMapsOfEmptySlicesOnRequest) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const MadeScene scene(2);
    const View view = madeView(2);
    SceneFacts facts = scene.facts(view);
    facts.light->lit.clear(); // no slice has a receiver
    Quality quality;
    EXPECT_EQ(evaluate(contextOf(scene, view, facts, quality), {4, false, false}).setup.maps.size(), 0U);
    quality.emptySlices = EmptySlices::Keep;
    EXPECT_EQ(evaluate(contextOf(scene, view, facts, quality), {4, false, false}).setup.maps.size(), 4U);
}

TEST(SchemeChoice, TakesNoMoreTexelsThanItsPromiseAsksForAndHardlyMore) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    int tested = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const MadeScene scene(seed);
        const View view = madeView(seed);
        const SceneFacts facts = scene.facts(view);
        Quality quality;
        quality.zPartitions.reset();
        quality.maxAliasing = 6;
        const SchemeContext context = contextOf(scene, view, facts, quality);
        for (const int slices : {1, 3, 6}) {
            const SchemeCandidate found = evaluate(context, {slices, false, true});
            const std::uint64_t budget = std::uint64_t{2048} * 2048;
            if (found.requiredTexels == 0 || found.requiredTexels > budget) continue;
            ++tested;
            EXPECT_TRUE(found.isWithinMaxAliasing);
            EXPECT_GE(found.options.texels, found.requiredTexels);
            EXPECT_LE(
                static_cast<double>(found.options.texels),
                static_cast<double>(found.requiredTexels) * std::exp2(0.25) + 1);
        }
    }
    EXPECT_GT(tested, 5);
}

TEST(SchemeChoice, RollsTheMapsAboutTheLightOnlyWhereThatIsWorthIt) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    int rolled = 0;
    int plain = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const MadeScene scene(seed % 20);
        const View view = madeView(seed);
        const SceneFacts facts = scene.facts(view);
        const SchemeContext context = contextOf(scene, view, facts, {});
        std::vector<SkippedEffect> omitted;
        const SchemeCandidate chosen = chosenScheme(context, omitted);
        const double without = evaluate(context, {4, false, false}).aliasingBound();
        const double with = evaluate(context, {4, false, true}).aliasingBound();
        EXPECT_EQ(chosen.choice.lightRoll, with <= without * kWorthwhile) << seed;
        (chosen.choice.lightRoll ? rolled : plain) += 1;
    }
    EXPECT_GT(rolled, 3);
    EXPECT_GT(plain, 3);
}

TEST(SchemeChoice, FacesThatAreThereStayWhereNewOnesWouldNotCome) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    int stay = 0;
    int come = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        const MadeScene scene(seed);
        const View view = madeView(seed);
        const SceneFacts facts = scene.facts(view);
        Quality quality;
        quality.facePartitions = Choice::Auto;
        SchemeContext context = contextOf(scene, view, facts, quality);
        context.before = planFrame(view, quality, facts).memory.scheme;
        if (!context.before) continue;
        context.receivers = receiversOf(context);
        const auto hasFacesAfter = [&](bool faces) {
            context.before->choice.faces = faces;
            std::vector<SkippedEffect> omitted;
            return chosenScheme(context, omitted).choice.faces;
        };
        const bool stays = hasFacesAfter(true);
        const bool comes = hasFacesAfter(false);
        EXPECT_TRUE(stays || !comes) << seed;
        stay += stays && !comes ? 1 : 0;
        come += comes ? 1 : 0;
    }
    EXPECT_GT(stay, 0);
    EXPECT_GT(come, 0);
}

/// What takes the place of a scheme that has to go: of those that the best does not dominate the one whose number of
/// maps is nearest, the better of two that are as near.
SchemeCandidate successor(const SchemeContext& context) {
    std::vector<SchemeCandidate> candidates;
    for (const SchemeChoice& choice : openChoices(context))
        candidates.push_back(evaluate(context, choice));
    const SchemeCandidate best = *std::min_element(candidates.begin(), candidates.end(), isBetter);
    std::erase_if(candidates, [&](const SchemeCandidate& a) {
        if (a.isWithinMaxAliasing != best.isWithinMaxAliasing) return true;
        return best.isWithinMaxAliasing ? static_cast<double>(a.cost) * kCheaper > static_cast<double>(best.cost)
                                        : a.aliasingBound() * kLower > best.aliasingBound();
    });
    const auto change = [&](const SchemeCandidate& a) {
        const std::size_t maps = a.setup.maps.size();
        return std::max(maps, context.before->maps) - std::min(maps, context.before->maps);
    };
    return *std::min_element(
        candidates.begin(), candidates.end(), [&](const SchemeCandidate& a, const SchemeCandidate& b) {
            return change(a) < change(b) || (change(a) == change(b) && isBetter(a, b));
        });
}

TEST(SchemeChoice, WhatFollowsADominatedSchemeChangesTheNumberOfMapsTheLeast) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    int differs = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const MadeScene scene(seed);
        const View view = madeView(seed);
        const SceneFacts facts = scene.facts(view);
        Quality quality;
        quality.zPartitions.reset();
        quality.facePartitions = Choice::Auto;
        quality.maxAliasing = seed % 2 == 0 ? 1000 : 4;
        SchemeContext context = contextOf(scene, view, facts, quality);
        context.before = planFrame(view, quality, facts).memory.scheme;
        if (!context.before) continue;
        for (const int slices : {1, 6, kMaxSlices}) {
            context.before->choice.slices = slices;
            context.before->choice.faces = false;
            context.before->emptySlices = 0;
            context.before->maps = static_cast<std::size_t>(slices);
            context.before->framesDominated = kFramesBeforeSchemeGoes; // it goes wherever it is still dominated
            context.receivers = receiversOf(context);
            std::vector<SkippedEffect> omitted;
            const SchemeCandidate chosen = chosenScheme(context, omitted);
            if (chosen.choice.slices == slices && !chosen.choice.faces) continue; // it was not dominated
            const SchemeCandidate expected = successor(context);
            EXPECT_EQ(chosen.choice.slices, expected.choice.slices) << seed << ", before " << slices;
            EXPECT_EQ(chosen.choice.faces, expected.choice.faces) << seed << ", before " << slices;
            ++differs;
        }
    }
    EXPECT_GT(differs, 4);
}

} // namespace
} // namespace gnomon::plan
