// The kind of shadows for each combination of what decides it, and the reason.
#include "plan/plan_frame.h"
#include "plan/shadow_decision.h"

#include <gtest/gtest.h>

namespace gnomon::plan {
namespace {

constexpr Capabilities kBackends[] = {kSoftwareCapabilities, kOpenGlCapabilities};

Quality withShadows(ShadowMode mode) {
    Quality quality;
    quality.shadows = mode;
    return quality;
}

void expectDecision(const Quality& quality, const Capabilities& backend, ShadowMode mode, ShadowReason reason) {
    const ShadowDecision decision = chooseShadows(quality, backend);
    EXPECT_EQ(decision.mode, mode);
    EXPECT_EQ(decision.reason, reason);
}

TEST(ShadowDecision, OfAutoFollowsTheBackend) {
    const Quality quality = withShadows(ShadowMode::Auto);
    expectDecision(quality, kSoftwareCapabilities, ShadowMode::Exact, ShadowReason::BackendIsExact);
    expectDecision(quality, kOpenGlCapabilities, ShadowMode::Maps, ShadowReason::BackendHasMaps);
}

TEST(ShadowDecision, OfAutoIsMapsIfTheyAreRequestedOrExactOnesTakeTooLong) {
    for (const Capabilities& backend : kBackends)
        for (const ShadowReason reason : {ShadowReason::MapsRequested, ShadowReason::FrameTime}) {
            Quality quality = withShadows(ShadowMode::Auto);
            quality.mapsBecause = reason;
            expectDecision(quality, backend, ShadowMode::Maps, reason);
        }
}

TEST(ShadowDecision, OfAutoIsOffWithoutASun) {
    for (const Capabilities& backend : kBackends)
        for (const Shading shading : {Shading::Headlight, Shading::Unlit}) {
            Quality quality = withShadows(ShadowMode::Auto);
            quality.look.shading = shading;
            quality.mapsBecause = ShadowReason::MapsRequested;
            ASSERT_TRUE(hasNoSun(shading));
            expectDecision(quality, backend, ShadowMode::Off, ShadowReason::NoSun);
        }
}

TEST(ShadowDecision, OfEveryOtherKindIsThatKind) {
    for (const Capabilities& backend : kBackends)
        for (const ShadowMode mode : {ShadowMode::Off, ShadowMode::Maps, ShadowMode::Exact, ShadowMode::Rays}) {
            Quality quality = withShadows(mode);
            quality.mapsBecause = ShadowReason::MapsRequested;
            expectDecision(quality, backend, mode, ShadowReason::Requested);
        }
}

TEST(ShadowDecision, IsPartOfThePlan) {
    Quality quality = withShadows(ShadowMode::Auto);
    const SceneFacts facts{.bounds = {{-1, -1, -1}, {1, 1, 1}}, .visible = {}, .light = {}};
    View view;
    view.camera.eye = {0, 0, 9};
    const FramePlan exact = planFrame(view, quality, facts, {}, kSoftwareCapabilities).plan;
    EXPECT_EQ(exact.quality.shadows, ShadowMode::Exact);
    EXPECT_EQ(exact.shadowReason, ShadowReason::BackendIsExact);
    EXPECT_TRUE(exact.passes.empty());
    EXPECT_FALSE(exact.sampleGridMaps.empty());
    quality.mapsBecause = ShadowReason::MapsRequested;
    const FramePlan maps = planFrame(view, quality, facts, {}, kSoftwareCapabilities).plan;
    EXPECT_EQ(maps.quality.shadows, ShadowMode::Maps);
    EXPECT_EQ(maps.shadowReason, ShadowReason::MapsRequested);
    EXPECT_FALSE(maps.passes.empty());
    EXPECT_TRUE(maps.sampleGridMaps.empty());
}

} // namespace
} // namespace gnomon::plan
