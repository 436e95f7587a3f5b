// What settings ask for together, and what contradicts itself.
#include "core/error.h"
#include "settings/contradictions.h"
#include "settings/resolve.h"
#include "settings/usage_error.h"

#include <gtest/gtest.h>

#include <numbers>

namespace gnomon::settings {
namespace {

/// What is said against `settings`; empty if nothing is.
std::string objection(const Settings& settings) {
    try {
        requireSound(settings);
        viewOf(settings, hierarchy::ModelSummary());
        return {};
    } catch (const UsageError& error) {
        return error.message;
    }
}

TEST(Resolve, TakesTheQualityAsItIs) {
    Settings settings;
    settings.quality.filter = 3;
    settings.quality.near = 2;
    EXPECT_EQ(qualityOf(settings).filter, 3);
    EXPECT_EQ(qualityOf(settings).near, 2);
    EXPECT_EQ(qualityOf(settings).warp.rule, shadow::WarpRule::Auto);
}

TEST(Resolve, APointLightHasMapsOfACubeThroughOpenGlTooAndNoGround) {
    Settings settings;
    settings.lightAt = glm::dvec3(1, 2, 3);
    EXPECT_EQ(objection(settings), "");
    EXPECT_EQ(qualityOf(settings).look.shading, plan::Shading::Lit);
    for (const plan::ShadowMode mode :
         {plan::ShadowMode::Exact, plan::ShadowMode::Rays, plan::ShadowMode::Off, plan::ShadowMode::Maps}) {
        settings.quality.shadows = mode;
        EXPECT_EQ(objection(settings), "");
        Settings throughGl = settings;
        throughGl.backend = Backend::Osmesa;
        EXPECT_EQ(objection(throughGl).empty(), mode != plan::ShadowMode::Exact);
    }
    EXPECT_THROW(requireDirectionalLight(settings, "sun hours"), UsageError);
    for (const auto& change : std::vector<void (*)(Settings&)>{
             [](Settings& s) { s.quality.zPartitions = 2; },
             [](Settings& s) { s.quality.splitLambda = 0.5; },
             [](Settings& s) { s.quality.facePartitions = plan::Choice::On; },
             [](Settings& s) { s.quality.stabilize = true; },
             [](Settings& s) { s.eta = 0.5; },
             [](Settings& s) {
                 s.isWarpGiven = true;
                 s.quality.warp.rule = shadow::WarpRule::Lspsm;
             },
             [](Settings& s) { s.quality.look.ground = true; }}) {
        Settings other = settings;
        change(other);
        EXPECT_NE(objection(other).find("--light-at"), std::string::npos);
    }
}

TEST(Resolve, EtaAndTheFocusSettleTheWarp) {
    Settings settings;
    settings.eta = 0.25;
    EXPECT_EQ(qualityOf(settings).warp.rule, shadow::WarpRule::Eta);
    EXPECT_EQ(qualityOf(settings).warp.eta, 0.25);
    settings.eta.reset();
    settings.tsmFocus = 0;
    settings.quality.warp.rule = shadow::WarpRule::Tsm;
    EXPECT_FALSE(qualityOf(settings).warp.tsmFocus) << "0 is auto, which the warp finds by itself";
    settings.tsmFocus = 2;
    EXPECT_EQ(qualityOf(settings).warp.tsmFocus, 2);
}

TEST(Resolve, TheViewHasOneCamera) {
    Settings settings;
    settings.eye = settings.target = glm::dvec3(1, 2, 3);
    EXPECT_EQ(objection(settings), "--eye and --target are the same point; change one of them");
    EXPECT_TRUE(isPosed(settings));
    settings.eye = settings.target = std::nullopt;
    settings.cameraFile = "camera.json";
    EXPECT_TRUE(isPosed(settings));
    EXPECT_THROW(readCamera(settings), Error) << "there is no such file";
    EXPECT_FALSE(isPosed(Settings()));
}

TEST(Resolve, AModelIsFramedFromWhateverIsUp) {
    hierarchy::ModelSummary summary;
    summary.bounds = {{-1, -2, -3}, {1, 2, 3}};
    for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), {0, 0, 1}, {1, 0, 0}, {0, -2, 0}}) {
        Settings settings;
        settings.up = up;
        settings.fovYDegrees = 90;
        settings.imageSize = {300, 200};
        const plan::View view = viewOf(settings, summary);
        EXPECT_EQ(view.width, 300);
        EXPECT_EQ(view.height, 200);
        const glm::dvec3 aside = view.camera.target - up * glm::dot(view.camera.target, up) / glm::dot(up, up);
        EXPECT_LT(glm::length(aside), 1.5) << "near the upright line through the middle";
        EXPECT_EQ(view.up, up);
        EXPECT_GT(glm::dot(view.light().unit(), glm::normalize(up)), 0.8) << "the sun follows";
        EXPECT_GT(glm::dot(view.towardsLight, view.camera.eye - view.camera.target), 0) << "lit from the front";
        EXPECT_DOUBLE_EQ(view.camera.fovYRadians, std::numbers::pi / 2);
        EXPECT_GT(glm::dot(view.camera.eye, up), 0) << "from a little above";
    }
}

TEST(Resolve, ASideFramesTheModelAndContradictsAnotherCamera) {
    Settings settings;
    settings.side = path::ViewSide::Left;
    hierarchy::ModelSummary summary;
    summary.bounds = {{-1, -2, -3}, {1, 2, 3}};
    summary.up.direction = {0, 0, 1};
    const plan::View view = viewOf(settings, summary);
    EXPECT_LT(view.camera.eye.x, -1);
    EXPECT_EQ(view.camera.up, glm::dvec3(0, 0, 1)) << "as the model says";
    EXPECT_EQ(view.towardsLight, glm::dvec3(0.4, -0.3, 1)) << "likewise";
    settings.towardsLight = {1, 2, 3};
    settings.isLightGiven = true;
    EXPECT_EQ(viewOf(settings, summary).towardsLight, glm::dvec3(1, 2, 3)) << "in the source's axes";
    settings.eye = glm::dvec3(5);
    EXPECT_EQ(
        objection(settings),
        "--view left and --eye 5,5,5 contradict each other: --view sets the position of the camera");
    settings.eye.reset();
    settings.camera = Camera();
    EXPECT_FALSE(isFramed(settings));
}

// A light and a way up outlast the model's own, and a camera's target is the middle where only the eye is given.
TEST(Resolve, WhatIsGivenStands) {
    hierarchy::ModelSummary summary;
    summary.bounds = {{0, 0, 0}, {2, 4, 6}};
    summary.up.direction = {0, 0, 1};
    Settings settings;
    settings.up = glm::dvec3(1, 0, 0);
    settings.eye = glm::dvec3(9, 9, 9);
    const plan::View view = viewOf(settings, summary);
    EXPECT_EQ(view.camera.target, glm::dvec3(1, 2, 3));
    EXPECT_EQ(view.camera.eye, glm::dvec3(9, 9, 9));
    EXPECT_EQ(view.camera.up, glm::dvec3(1, 0, 0));
    EXPECT_EQ(view.up, glm::dvec3(1, 0, 0));
}

} // namespace
} // namespace gnomon::settings
