// The time target against machines whose frame time is a known function of what is drawn: no clock has a part in it.
#include "core/random.h"
#include "plan/plan_frame.h"
#include "viewer/quality_governor.h"

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
    double aliasingBound = 1.6; // with 4 slices and 2048x2048 texels

    double texels(const QualityLevel& level) const {
        return static_cast<double>(level.texelsWidth) * level.texelsHeight;
    }

    double trianglesOf(const QualityLevel& level) const { return triangles * std::pow(level.errorPixels, -elasticity); }

    double imageMs(const QualityLevel& level) const {
        return msPerTriangle * trianglesOf(level) + msPerPixel * kPixels * level.resolution * level.resolution;
    }

    double shadowMs(const QualityLevel& level) const {
        return msPerTexel * texels(level) + msPerCaster * casters * (0.5 + 0.125 * level.slices.value_or(4));
    }

    double boundFor(const QualityLevel& level, int fewerSlices, double texelPart) const {
        const double slices = std::max(level.slices.value_or(4) - fewerSlices, 1);
        return aliasingBound * std::sqrt(2048.0 * 2048 / (texels(level) * texelPart)) * (1 + 4 / slices) / 2;
    }

    double frameMs(const QualityLevel& level) const { return fixedMs + imageMs(level) + shadowMs(level); }

    FrameLoad load(const QualityLevel& level, double noise = 1) const {
        FrameLoad load;
        load.milliseconds = noise * frameMs(level);
        load.imageMs = noise * imageMs(level);
        load.shadowMs = noise * shadowMs(level);
        load.triangles = trianglesOf(level);
        load.pixels = kPixels * level.resolution * level.resolution;
        if (msPerTexel + msPerCaster > 0) {
            load.errors.aliasingBound = boundFor(level, 0, 1);
            if (level.slices.value_or(1) > 1) load.errors.fewerSlices = boundFor(level, 1, 1);
            load.errors.fewerTexels = boundFor(level, 0, 0.5);
            load.errors.texelShare = shadowMs(level) > 0 ? msPerTexel * texels(level) / shadowMs(level) : 0;
        }
        return load;
    }
};

/// Draws `frames`; the time of each.
std::vector<double> play(QualityGovernor& governor, const Machine& machine, int frames, double target = 33) {
    std::vector<double> times;
    for (int frame = 0; frame < frames; ++frame) {
        const FrameLoad load = machine.load(governor.level({}));
        times.push_back(load.milliseconds);
        governor.measure(load, target, {});
    }
    return times;
}

TEST(QualityGovernor, GivesUpNothingWhereThereIsTime) {
    QualityGovernor governor;
    play(governor, {.triangles = 100e3}, 100);
    EXPECT_EQ(governor.level({}), QualityLevel());
    EXPECT_EQ(governor.reductions({}), "");
    EXPECT_FALSE(governor.isExhausted());
}

TEST(QualityGovernor, HoldsTheTargetOnMachinesOfAllKindsWithinAFewFramesAndSwingsOnNone) {
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
        QualityGovernor governor;
        const std::vector<double> first = play(governor, machine, 60);
        overloaded += first[0] > 40 ? 1 : 0;
        const auto settled = std::find_if(first.rbegin(), first.rend(), [](double ms) { return ms > 40; });
        if (!governor.isExhausted()) {
            EXPECT_LE(first.rend() - settled, 20) << "frames until it holds";
        }
        // A minute at its pace, with noise and a slow frame now and then.
        int over = 0;
        int changes = 0;
        QualityLevel last = governor.level({});
        for (int frame = 0; frame < 1800; ++frame) {
            const double noise = random.uniform(0.95, 1.05) * (random.below(50) == 0 ? 2 : 1);
            governor.measure(machine.load(governor.level({}), noise), 33, {});
            over += machine.frameMs(governor.level({})) > 40 ? 1 : 0;
            changes += governor.level({}) != last ? 1 : 0;
            last = governor.level({});
        }
        EXPECT_LE(changes, 90) << "it swings";
        if (governor.isExhausted()) continue;
        EXPECT_LE(over, 90) << "of 1800 frames";
        if (governor.reductions({}).empty()) continue;
        EXPECT_GT(machine.frameMs(last), 33 * 0.4) << "more was given up than had to be";
    }
    EXPECT_GT(overloaded, 50) << "this tests nothing";
}

TEST(QualityGovernor, TakesWhatCostsTheLeastErrorForItsTime) {
    QualityGovernor pixels; // shading them is all that takes time: coarser parts would save nothing
    play(pixels, {.triangles = 1000, .msPerPixel = 60e-6}, 30);
    EXPECT_EQ(pixels.level({}).errorPixels, 1);
    EXPECT_LT(pixels.level({}).resolution, 1);
    EXPECT_GE(pixels.level({}).resolution, 0.5);

    QualityGovernor triangles;
    play(triangles, {.triangles = 2e6, .msPerPixel = 1e-6}, 30);
    EXPECT_GT(triangles.level({}).errorPixels, 1);

    QualityGovernor stuck; // parts that never get fewer: it learns to leave them
    play(stuck, {.triangles = 400e3, .elasticity = 0, .msPerPixel = 40e-6}, 60);
    EXPECT_LT(stuck.level({}).resolution, 0.8);

    QualityGovernor texels;
    const Machine filled{.triangles = 100e3, .msPerPixel = 5e-6, .msPerTexel = 10e-6, .aliasingBound = 0.5};
    play(texels, filled, 30);
    EXPECT_LT(texels.level({}).texelsWidth, 2048);
    EXPECT_EQ(texels.level({}).errorPixels, 1);
    EXPECT_EQ(texels.level({}).resolution, 1);

    QualityGovernor coarse; // half the texels would save more than fewer pixels, at many times the error
    const Machine aliased{.triangles = 50e3, .msPerPixel = 17.5e-6, .msPerTexel = 4.5e-6, .aliasingBound = 8};
    play(coarse, aliased, 30);
    EXPECT_EQ(coarse.level({}).texelsWidth, 2048) << coarse.reductions({});
    EXPECT_LT(coarse.level({}).resolution, 1);
}

TEST(QualityGovernor, TakesMapsForExactShadowsWhereThoseTakeTheTime) {
    // 50 ms with exact shadows, 15 with maps; what is left open may become maps.
    const auto played = [](bool mayBeExact) {
        QualityGovernor governor;
        QualityLevel wanted;
        wanted.mayBeExact = mayBeExact;
        for (int frame = 0; frame < 300; ++frame) {
            const bool isExact = governor.level(wanted).mayBeExact || !mayBeExact;
            FrameLoad load = Machine{.triangles = 100e3, .msPerPixel = 5e-6}.load(governor.level(wanted));
            load.resolvesPoints = isExact;
            load.shadowMs = isExact ? 35 : 4;
            load.milliseconds += load.shadowMs;
            if (isExact && mayBeExact) load.errors.withMaps = 1.5;
            if (!isExact) load.errors.aliasingBound = 1.5;
            governor.measure(load, 33, wanted);
        }
        return governor;
    };
    QualityLevel wanted;
    EXPECT_EQ(played(true).reductions(wanted), "exact shadows") << "all else is taken back, that would not fit";
    wanted.mayBeExact = false;
    EXPECT_EQ(played(false).level(wanted).mayBeExact, false);
    EXPECT_NE(played(false).reductions(wanted), "") << "what was asked for stays, so something else goes";
}

// A budget that guesses the time of exact shadows would try them every twelfth frame.
TEST(QualityGovernor, BringsExactShadowsBackOnceTheyFitByTheirMeasuredTime) {
    QualityGovernor governor;
    const QualityLevel wanted;
    int switches = 0;
    bool wasExact = true;
    const auto play = [&](double exactMs, int frames) {
        for (int frame = 0; frame < frames; ++frame) {
            FrameLoad load = Machine{.triangles = 100e3, .msPerPixel = 5e-6}.load(governor.level(wanted));
            load.resolvesPoints = governor.level(wanted).mayBeExact;
            load.shadowMs = load.resolvesPoints ? exactMs : exactMs / 10;
            load.milliseconds += load.shadowMs;
            (load.resolvesPoints ? load.errors.withMaps : load.errors.aliasingBound) = 1.5;
            governor.measure(load, 33, wanted);
            switches += governor.level(wanted).mayBeExact != wasExact ? 1 : 0;
            wasExact = governor.level(wanted).mayBeExact;
        }
    };
    play(60, 300);
    EXPECT_EQ(switches, 1);
    EXPECT_FALSE(wasExact);
    play(15, 60);
    EXPECT_EQ(switches, 2);
    EXPECT_TRUE(wasExact) << "another part of the scene, where they fit";
}

TEST(QualityGovernor, OneSlowFrameMovesNothing) {
    QualityGovernor governor;
    const Machine machine{.triangles = 100e3};
    for (int frame = 0; frame < 100; ++frame)
        governor.measure(machine.load(governor.level({}), frame % 3 == 0 ? 5 : 1), 33, {});
    EXPECT_EQ(governor.reductions({}), "");
}

TEST(QualityGovernor, TakesEverythingBackWhenThereIsTime) {
    QualityGovernor governor;
    const Machine slow{.fixedMs = 60, .msPerPixel = 60e-6, .msPerTexel = 10e-6, .msPerCaster = 1e-3, .casters = 1e5};
    play(governor, slow, 60);
    EXPECT_TRUE(governor.isExhausted());
    EXPECT_EQ(governor.level({}).resolution, 0.5);
    EXPECT_NE(governor.reductions({}).find("resolution 50%"), std::string::npos) << governor.reductions({});
    EXPECT_NE(governor.reductions({}).find("texels 2048x2048 -> "), std::string::npos) << governor.reductions({});
    EXPECT_NE(governor.reductions({}).find("slices 4 -> 1"), std::string::npos) << governor.reductions({});
    play(governor, {.triangles = 1000, .msPerPixel = 1e-6, .msPerTexel = 1e-9}, 400);
    EXPECT_EQ(governor.level({}), QualityLevel());
    EXPECT_FALSE(governor.isExhausted());
}

TEST(QualityGovernor, LeavesTheNumberOfSlicesToThePlanWhereItIsAuto) {
    QualityGovernor governor;
    const QualityLevel wanted{.slices = std::nullopt};
    for (int frame = 0; frame < 60; ++frame)
        governor.measure(Machine{.fixedMs = 200, .msPerCaster = 1e-3, .casters = 1e6}.load(wanted), 33, wanted);
    EXPECT_EQ(governor.level(wanted).slices, std::nullopt);
}

TEST(ShadowErrors, AreThoseOfPlansWithLess) {
    plan::View view;
    view.camera = {{0, 2, 30}, {0, 0, 0}, {0, 1, 0}, 1};
    plan::SceneFacts facts;
    facts.bounds = {{-10, -2, -10}, {10, 2, 10}};
    facts.visible = {18, 44, true};
    const auto aliasingBound = [&](int slices, int width, int height) {
        plan::Quality quality;
        quality.zPartitions = slices;
        quality.shadowTexelsWidth = width;
        quality.shadowTexelsHeight = height;
        const shadow::Aliasing aliasing = plan::planFrame(view, quality, facts).plan.aliasingBound;
        return std::max(aliasing.x, aliasing.z);
    };
    const plan::FramePlan plan = plan::planFrame(view, {}, facts).plan;
    const ShadowErrors errors = shadowErrors(plan, facts, true);
    EXPECT_EQ(errors.aliasingBound, aliasingBound(4, 2048, 2048));
    EXPECT_EQ(errors.fewerSlices, aliasingBound(3, 2048, 2048));
    EXPECT_EQ(errors.fewerTexels, aliasingBound(4, 2048, 1024));
    EXPECT_GT(*errors.fewerTexels, *errors.aliasingBound);
    EXPECT_TRUE(errors.texelShare > 0 && errors.texelShare <= 1) << errors.texelShare;
    EXPECT_FALSE(shadowErrors(plan, facts, false).fewerSlices);
    plan::Quality none;
    none.shadows = plan::ShadowMode::Off;
    EXPECT_FALSE(shadowErrors(plan::planFrame(view, none, facts).plan, facts, true).aliasingBound);
    plan::Quality exact;
    exact.shadows = plan::ShadowMode::Exact;
    plan::FramePlan chosen = plan::planFrame(view, exact, facts).plan;
    EXPECT_FALSE(shadowErrors(chosen, facts, true).withMaps) << "asked for";
    chosen.shadowReason = plan::ShadowReason::BackendIsExact;
    EXPECT_EQ(shadowErrors(chosen, facts, true).withMaps, aliasingBound(4, 2048, 2048));
}

} // namespace
} // namespace gnomon::viewer
