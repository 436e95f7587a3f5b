// The time target against machines whose frame time is a known function of what is drawn: no clock has a part in it.
#include "core/random.h"
#include "plan/plan_frame.h"
#include "viewer/detail_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::viewer {
namespace {

constexpr double kPixels = 1280.0 * 800;

/// A machine and a scene: what a frame takes follows from what is drawn. Its window has kPixels.
struct Machine {
    double fixedMs = 2;
    double triangles = 300e3; // at an error of 1 pixel
    double elasticity = 1;    // T ~ error^-elasticity
    double msPerTriangle = 40e-6;
    double msPerPixel = 20e-6;
    double msPerTexel = 0; // of maps
    double msPerCaster = 0;
    double casters = 0;
    double promised = 1.6; // with 4 slices and 2048x2048 texels

    double texels(const Effort& effort) const { return static_cast<double>(effort.texelsWidth) * effort.texelsHeight; }

    double trianglesOf(const Effort& effort) const { return triangles * std::pow(effort.errorPixels, -elasticity); }

    double imageMs(const Effort& effort) const {
        return msPerTriangle * trianglesOf(effort) + msPerPixel * kPixels * effort.resolution * effort.resolution;
    }

    double shadowMs(const Effort& effort) const {
        return msPerTexel * texels(effort) + msPerCaster * casters * (0.5 + 0.125 * effort.slices.value_or(4));
    }

    double promise(const Effort& effort, int fewerSlices, double texelPart) const {
        const double slices = std::max(effort.slices.value_or(4) - fewerSlices, 1);
        return promised * std::sqrt(2048.0 * 2048 / (texels(effort) * texelPart)) * (1 + 4 / slices) / 2;
    }

    double frameMs(const Effort& effort) const { return fixedMs + imageMs(effort) + shadowMs(effort); }

    FrameLoad load(const Effort& effort, double noise = 1) const {
        FrameLoad load;
        load.milliseconds = noise * frameMs(effort);
        load.imageMs = noise * imageMs(effort);
        load.shadowMs = noise * shadowMs(effort);
        load.triangles = trianglesOf(effort);
        load.pixels = kPixels * effort.resolution * effort.resolution;
        if (msPerTexel + msPerCaster > 0) {
            load.errors.promised = promise(effort, 0, 1);
            if (effort.slices.value_or(1) > 1) load.errors.fewerSlices = promise(effort, 1, 1);
            load.errors.fewerTexels = promise(effort, 0, 0.5);
            load.errors.texelShare = shadowMs(effort) > 0 ? msPerTexel * texels(effort) / shadowMs(effort) : 0;
        }
        return load;
    }
};

/// Draws `frames`; the time of each.
std::vector<double> play(DetailBudget& budget, const Machine& machine, int frames, double target = 33) {
    std::vector<double> times;
    for (int frame = 0; frame < frames; ++frame) {
        const FrameLoad load = machine.load(budget.effort({}));
        times.push_back(load.milliseconds);
        budget.measure(load, target, {});
    }
    return times;
}

TEST(DetailBudget, GivesUpNothingWhereThereIsTime) {
    DetailBudget budget;
    play(budget, {.triangles = 100e3}, 100);
    EXPECT_EQ(budget.effort({}), Effort());
    EXPECT_EQ(budget.givenUp({}), "");
    EXPECT_FALSE(budget.isExhausted());
}

TEST(DetailBudget, HoldsTheTargetOnMachinesOfAllKindsWithinAFewFramesAndSwingsOnNone) {
    Random random(1);
    int overloaded = 0;
    for (int kind = 0; kind < 200; ++kind) {
        SCOPED_TRACE(kind);
        Machine machine;
        machine.fixedMs = random.uniform(1, 12);
        machine.triangles = random.uniform(50e3, 1e6);
        machine.elasticity = random.uniform(0.02, 1.2);
        machine.msPerPixel = random.uniform(5e-6, 40e-6);
        machine.msPerTexel = random.uniform(0, 2e-6);
        machine.msPerCaster = random.uniform(0, 20e-6);
        machine.casters = machine.triangles;
        DetailBudget budget;
        const std::vector<double> first = play(budget, machine, 60);
        overloaded += first[0] > 40 ? 1 : 0;
        const auto settled = std::find_if(first.rbegin(), first.rend(), [](double ms) { return ms > 40; });
        if (!budget.isExhausted()) {
            EXPECT_LE(first.rend() - settled, 20) << "frames until it holds";
        }
        // A minute at its pace, with noise and a slow frame now and then.
        int over = 0;
        int changes = 0;
        Effort last = budget.effort({});
        for (int frame = 0; frame < 1800; ++frame) {
            const double noise = random.uniform(0.95, 1.05) * (random.below(50) == 0 ? 2 : 1);
            budget.measure(machine.load(budget.effort({}), noise), 33, {});
            over += machine.frameMs(budget.effort({})) > 40 ? 1 : 0;
            changes += budget.effort({}) != last ? 1 : 0;
            last = budget.effort({});
        }
        EXPECT_LE(changes, 90) << "it swings";
        if (budget.isExhausted()) continue;
        EXPECT_LE(over, 90) << "of 1800 frames";
        if (budget.givenUp({}).empty()) continue;
        EXPECT_GT(machine.frameMs(last), 33 * 0.4) << "more was given up than had to be";
    }
    EXPECT_GT(overloaded, 50) << "this tests nothing";
}

TEST(DetailBudget, TakesWhatCostsTheLeastErrorForItsTime) {
    DetailBudget pixels; // shading them is all that takes time: coarser parts would save nothing
    play(pixels, {.triangles = 1000, .msPerPixel = 60e-6}, 30);
    EXPECT_EQ(pixels.effort({}).errorPixels, 1);
    EXPECT_LT(pixels.effort({}).resolution, 1);
    EXPECT_GE(pixels.effort({}).resolution, 0.5);

    DetailBudget triangles;
    play(triangles, {.triangles = 2e6, .msPerPixel = 1e-6}, 30);
    EXPECT_GT(triangles.effort({}).errorPixels, 1);

    DetailBudget stuck; // parts that never get fewer: it learns to leave them
    play(stuck, {.triangles = 400e3, .elasticity = 0, .msPerPixel = 40e-6}, 60);
    EXPECT_LT(stuck.effort({}).resolution, 0.8);

    DetailBudget texels;
    const Machine filled{.triangles = 100e3, .msPerPixel = 5e-6, .msPerTexel = 10e-6, .promised = 0.5};
    play(texels, filled, 30);
    EXPECT_LT(texels.effort({}).texelsWidth, 2048);
    EXPECT_EQ(texels.effort({}).errorPixels, 1);
    EXPECT_EQ(texels.effort({}).resolution, 1);

    DetailBudget coarse; // half the texels would save more than fewer pixels, at many times the error
    const Machine aliased{.triangles = 50e3, .msPerPixel = 17.5e-6, .msPerTexel = 4.5e-6, .promised = 8};
    play(coarse, aliased, 30);
    EXPECT_EQ(coarse.effort({}).texelsWidth, 2048) << coarse.givenUp({});
    EXPECT_LT(coarse.effort({}).resolution, 1);
}

TEST(DetailBudget, TakesMapsForExactShadowsWhereThoseTakeTheTime) {
    // 50 ms with exact shadows, 15 with maps; what is left open may become maps.
    const auto played = [](bool mayBeExact) {
        DetailBudget budget;
        Effort wanted;
        wanted.mayBeExact = mayBeExact;
        for (int frame = 0; frame < 300; ++frame) {
            const bool isExact = budget.effort(wanted).mayBeExact || !mayBeExact;
            FrameLoad load = Machine{.triangles = 100e3, .msPerPixel = 5e-6}.load(budget.effort(wanted));
            load.decidesPoints = isExact;
            load.shadowMs = isExact ? 35 : 4;
            load.milliseconds += load.shadowMs;
            if (isExact && mayBeExact) load.errors.asMaps = 1.5;
            if (!isExact) load.errors.promised = 1.5;
            budget.measure(load, 33, wanted);
        }
        return budget;
    };
    Effort wanted;
    EXPECT_EQ(played(true).givenUp(wanted), "exact shadows") << "all else is taken back, that would not fit";
    wanted.mayBeExact = false;
    EXPECT_EQ(played(false).effort(wanted).mayBeExact, false);
    EXPECT_NE(played(false).givenUp(wanted), "") << "what was asked for stays, so something else goes";
}

// A budget that guesses the time of exact shadows would try them every twelfth frame.
TEST(DetailBudget, BringsExactShadowsBackOnceTheyFitByTheirMeasuredTime) {
    DetailBudget budget;
    const Effort wanted;
    int switches = 0;
    bool wasExact = true;
    const auto play = [&](double exactMs, int frames) {
        for (int frame = 0; frame < frames; ++frame) {
            FrameLoad load = Machine{.triangles = 100e3, .msPerPixel = 5e-6}.load(budget.effort(wanted));
            load.decidesPoints = budget.effort(wanted).mayBeExact;
            load.shadowMs = load.decidesPoints ? exactMs : exactMs / 10;
            load.milliseconds += load.shadowMs;
            (load.decidesPoints ? load.errors.asMaps : load.errors.promised) = 1.5;
            budget.measure(load, 33, wanted);
            switches += budget.effort(wanted).mayBeExact != wasExact ? 1 : 0;
            wasExact = budget.effort(wanted).mayBeExact;
        }
    };
    play(60, 300);
    EXPECT_EQ(switches, 1);
    EXPECT_FALSE(wasExact);
    play(15, 60);
    EXPECT_EQ(switches, 2);
    EXPECT_TRUE(wasExact) << "another part of the scene, where they fit";
}

TEST(DetailBudget, OneSlowFrameMovesNothing) {
    DetailBudget budget;
    const Machine machine{.triangles = 100e3};
    for (int frame = 0; frame < 100; ++frame)
        budget.measure(machine.load(budget.effort({}), frame % 3 == 0 ? 5 : 1), 33, {});
    EXPECT_EQ(budget.givenUp({}), "");
}

TEST(DetailBudget, TakesEverythingBackWhenThereIsTime) {
    DetailBudget budget;
    const Machine slow{.fixedMs = 60, .msPerPixel = 60e-6, .msPerTexel = 10e-6, .msPerCaster = 1e-3, .casters = 1e5};
    play(budget, slow, 60);
    EXPECT_TRUE(budget.isExhausted());
    EXPECT_EQ(budget.effort({}).resolution, 0.5);
    EXPECT_NE(budget.givenUp({}).find("resolution 50%"), std::string::npos) << budget.givenUp({});
    EXPECT_NE(budget.givenUp({}).find("texels 2048x2048 -> "), std::string::npos) << budget.givenUp({});
    EXPECT_NE(budget.givenUp({}).find("slices 4 -> 1"), std::string::npos) << budget.givenUp({});
    play(budget, {.triangles = 1000, .msPerPixel = 1e-6, .msPerTexel = 1e-9}, 400);
    EXPECT_EQ(budget.effort({}), Effort());
    EXPECT_FALSE(budget.isExhausted());
}

TEST(DetailBudget, LeavesTheNumberOfSlicesToThePlanWhereItIsAuto) {
    DetailBudget budget;
    const Effort wanted{.slices = std::nullopt};
    for (int frame = 0; frame < 60; ++frame)
        budget.measure(Machine{.fixedMs = 200, .msPerCaster = 1e-3, .casters = 1e6}.load(wanted), 33, wanted);
    EXPECT_EQ(budget.effort(wanted).slices, std::nullopt);
}

TEST(ShadowErrors, AreThoseOfPlansWithLess) {
    plan::View view;
    view.camera = {{0, 2, 30}, {0, 0, 0}, {0, 1, 0}, 1};
    plan::SceneFacts facts;
    facts.bounds = {{-10, -2, -10}, {10, 2, 10}};
    facts.visible = {18, 44, true};
    const auto promised = [&](int slices, int width, int height) {
        plan::Quality quality;
        quality.zPartitions = slices;
        quality.shadowTexelsWidth = width;
        quality.shadowTexelsHeight = height;
        const shadow::Aliasing aliasing = plan::planFrame(view, quality, facts).plan.promised;
        return std::max(aliasing.x, aliasing.z);
    };
    const plan::FramePlan plan = plan::planFrame(view, {}, facts).plan;
    const ShadowErrors errors = shadowErrors(plan, facts, true);
    EXPECT_EQ(errors.promised, promised(4, 2048, 2048));
    EXPECT_EQ(errors.fewerSlices, promised(3, 2048, 2048));
    EXPECT_EQ(errors.fewerTexels, promised(4, 2048, 1024));
    EXPECT_GT(*errors.fewerTexels, *errors.promised);
    EXPECT_TRUE(errors.texelShare > 0 && errors.texelShare <= 1) << errors.texelShare;
    EXPECT_FALSE(shadowErrors(plan, facts, false).fewerSlices);
    plan::Quality none;
    none.shadows = plan::ShadowMode::Off;
    EXPECT_FALSE(shadowErrors(plan::planFrame(view, none, facts).plan, facts, true).promised);
    plan::Quality exact;
    exact.shadows = plan::ShadowMode::Exact;
    plan::FramePlan chosen = plan::planFrame(view, exact, facts).plan;
    EXPECT_FALSE(shadowErrors(chosen, facts, true).asMaps) << "asked for";
    chosen.shadowReason = plan::ShadowReason::BackendIsExact;
    EXPECT_EQ(shadowErrors(chosen, facts, true).asMaps, promised(4, 2048, 2048));
}

} // namespace
} // namespace gnomon::viewer
