// Every threshold of plan/hysteresis.h as a table: what holds, for exactly how many frames, and what moves at once.
#include "made_scene.h"
#include "plan/hysteresis.h"
#include "plan/plan_memory.h"

#include <gtest/gtest.h>

#include <functional>

namespace gnomon::plan {
namespace {

View anyView() {
    return madeView(2);
}

/// Surfaces from `nearest` to `farthest`, all lit.
SceneFacts surfaces(double nearest, double farthest) {
    SceneFacts facts;
    facts.visible = {nearest, farthest, true};
    facts.light = SceneFacts::Light();
    facts.light->lit = {{nearest, farthest}};
    return facts;
}

struct HysteresisRow {
    const char* what;
    std::function<void(Quality&)> with;
    SceneFacts before;
    SceneFacts after;
    std::function<double(const FramePlan&)> value;
    int framesHeld; // of the old value, once `after` is seen
};

double nearOf(const FramePlan& plan) {
    return plan.near;
}

double farOf(const FramePlan& plan) {
    return plan.far;
}

double mapsOf(const FramePlan& plan) {
    return static_cast<double>(plan.passes.size());
}

SceneFacts gapInTheSecondSlice() {
    SceneFacts facts = surfaces(1, 100);
    facts.light->lit = {{1, 3}, {12, 100}}; // it reaches from 3.2 to 10
    return facts;
}

const std::vector<HysteresisRow>& table() {
    const auto stable = [](Quality& quality) { quality.stabilize = true; };
    const auto plain = [](Quality&) {};
    static const std::vector<HysteresisRow> rows{
        {"near falls", plain, surfaces(8, 100), surfaces(2, 100), nearOf, 0},
        {"near rises", plain, surfaces(2, 100), surfaces(8, 100), nearOf, kFramesBeforeNearRises - 1},
        {"far falls", plain, surfaces(2, 100), surfaces(2, 30), farOf, 0},
        {"far rises", plain, surfaces(2, 30), surfaces(2, 100), farOf, 0},
        {"far falls, stabilised", stable, surfaces(2, 100), surfaces(2, 30), farOf, kFramesBeforeNearRises - 1},
        {"far rises, stabilised", stable, surfaces(2, 30), surfaces(2, 100), farOf, 0},
        {"a slice without receivers loses its map",
         plain,
         surfaces(1, 100),
         gapInTheSecondSlice(),
         mapsOf,
         2 * kFramesBeforeMapsGo - 1},
        {"a receiver without a map gets it", plain, gapInTheSecondSlice(), surfaces(1, 100), mapsOf, 0},
    };
    return rows;
}

TEST(Hysteresis, HoldsForExactlyAsManyFramesAsItsTableSays) {
    for (const HysteresisRow& row : table()) {
        SCOPED_TRACE(row.what);
        Quality quality;
        row.with(quality);
        PlannedFrame frame = planFrame(anyView(), quality, row.before);
        const double old = row.value(frame.plan);
        ASSERT_NE(old, row.value(planFrame(anyView(), quality, row.after).plan)) << "the row tests nothing";
        int held = -1;
        do {
            frame = planFrame(anyView(), quality, row.after, frame.memory);
            ++held;
        } while (row.value(frame.plan) == old && held < 1000);
        EXPECT_EQ(held, row.framesHeld);
        EXPECT_EQ(row.value(frame.plan), row.value(planFrame(anyView(), quality, row.after).plan)) << "it went halfway";
    }
}

TEST(Hysteresis, TheThresholdsAreThoseThatTheStoredFiguresWereTakenWith) {
    EXPECT_EQ(kFramesBeforeNearRises, 12);
    EXPECT_EQ(kFramesBeforeMapsGo, 96);
    EXPECT_EQ(kFramesBeforeSchemeGoes, 96);
    EXPECT_EQ(kCheaper, 0.75);
    EXPECT_EQ(kLower, 0.85);
    EXPECT_EQ(kWorthwhile, 0.95);
    EXPECT_EQ(kStillWorthwhile, 0.99);
}

TEST(Hysteresis, ADipStartsTheWaitForAHigherNearAnew) {
    PlannedFrame frame = planFrame(anyView(), {}, surfaces(2, 100));
    for (int i = 0; i < 3 * kFramesBeforeNearRises; ++i) {
        frame = planFrame(anyView(), {}, surfaces(i % kFramesBeforeNearRises == 0 ? 2 : 8, 100), frame.memory);
        EXPECT_EQ(frame.plan.near, 2) << i;
        EXPECT_EQ(
            frame.plan.nearFrom, i % kFramesBeforeNearRises == 0 ? DepthSource::NearestSurface : DepthSource::Held);
    }
}

/// A view, facts and quality under which twelve slices are dominated: one would do.
struct Dominated {
    MadeScene scene{3};
    View view = madeView(3);
    Quality quality;
    PlannedFrame frame;

    Dominated() {
        quality.zPartitions.reset();
        quality.maxAliasing = 1000;
        frame = planFrame(view, quality, scene.facts(view));
    }

    /// The next frame after one that had come to `slices`, dominated for `frames` frames so far.
    PlannedFrame after(int slices, int frames) const {
        PlanMemory memory = frame.memory;
        memory.scheme->choice.slices = slices;
        memory.scheme->emptySlices = 0;
        memory.scheme->framesDominated = frames;
        return planFrame(view, quality, scene.facts(view), memory);
    }
};

TEST(Hysteresis, ADominatedSchemeGoesInItsLastFrameAndNotBefore) {
    const Dominated dominated;
    const int best = dominated.frame.memory.scheme->choice.slices;
    for (const int frames : {0, 1, kFramesBeforeSchemeGoes - 2}) {
        const PlannedFrame held = dominated.after(12, frames);
        EXPECT_EQ(held.memory.scheme->choice.slices, 12);
        EXPECT_EQ(held.memory.scheme->framesDominated, frames + 1);
    }
    const PlannedFrame gone = dominated.after(12, kFramesBeforeSchemeGoes - 1);
    EXPECT_EQ(gone.memory.scheme->choice.slices, best);
    EXPECT_EQ(gone.memory.scheme->framesDominated, 0);
    const PlannedFrame bestOfAll = dominated.after(best, kFramesBeforeSchemeGoes - 1);
    EXPECT_EQ(bestOfAll.memory.scheme->choice.slices, best) << "the best dominates itself";
    EXPECT_EQ(bestOfAll.memory.scheme->framesDominated, 0);
}

TEST(Hysteresis, ABrokenPromiseWaitsForNothing) {
    Dominated dominated;
    const PlannedFrame few = dominated.after(1, 0);
    ASSERT_EQ(few.memory.scheme->choice.slices, 1);
    double kept = 0;
    for (double aliasing = 1; aliasing < 1000 && kept == 0; aliasing *= 1.1) {
        dominated.quality.maxAliasing = aliasing;
        const PlannedFrame now =
            planFrame(dominated.view, dominated.quality, dominated.scene.facts(dominated.view), few.memory);
        if (now.plan.isBoundKept && now.memory.scheme->choice.slices > 1) kept = aliasing;
    }
    EXPECT_GT(kept, 0) << "one slice was held although it breaks a promise that others keep";
}

TEST(Hysteresis, WhatAPlanKeepsForTheNextIsItsMemoryAlone) {
    // Two histories that end in equal memories give equal plans.
    const MadeScene scene(5);
    const View view = madeView(5);
    Quality quality;
    quality.zPartitions.reset();
    const PlannedFrame first = planFrame(view, quality, scene.facts(view));
    const PlannedFrame once = planFrame(view, quality, scene.facts(view), first.memory);
    const PlannedFrame again = planFrame(view, quality, scene.facts(view), PlanMemory(first.memory));
    EXPECT_EQ(once.plan.cost, again.plan.cost);
    EXPECT_EQ(once.plan.near, again.plan.near);
    ASSERT_EQ(once.plan.passes.size(), again.plan.passes.size());
    for (std::size_t i = 0; i < once.plan.passes.size(); ++i)
        EXPECT_EQ(once.plan.passes[i].map.lightClipFromCamera(), again.plan.passes[i].map.lightClipFromCamera());
}

TEST(Hysteresis, ForgetsTheSchemeOfAViewWithoutMapsAndTheRangeOfOneWithNothing) {
    PlannedFrame frame = planFrame(anyView(), {}, surfaces(2, 100));
    EXPECT_TRUE(frame.memory.depth && frame.memory.scheme);
    SceneFacts dark = surfaces(2, 100);
    dark.light->lit.clear();
    EXPECT_FALSE(planFrame(anyView(), {}, dark, frame.memory).memory.scheme);
    EXPECT_TRUE(planFrame(anyView(), {}, dark, frame.memory).memory.depth);
    SceneFacts nothing;
    nothing.visible = SceneFacts::Visible();
    EXPECT_FALSE(planFrame(anyView(), {}, nothing, frame.memory).memory.depth);
}

} // namespace
} // namespace gnomon::plan
