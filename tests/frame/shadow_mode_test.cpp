// Shadows whose mode is left open: which frames get exact ones, which maps, and which none at all.
#include "frame/drawn_model.h"
#include "frame/exact_forecast.h"
#include "hierarchy/scene_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::frame {
namespace {

using plan::Effect;
using plan::OmissionReason;
using plan::ShadowMode;
using plan::ShadowReason;

/// A crate on a plain, seen from above and aside.
struct Crate {
    Crate() {
        tests::SceneMesh scene;
        scene.addGround(64, 8);
        scene.addBox({-1, 0, -1}, {1, 2, 1});
        model = std::make_unique<DrawnModel>(scene.model());
        view.camera = {{3, 4, 10}, {0, 1, 0}, {0, 1, 0}, 1};
        view.width = 160;
        view.height = 120;
        quality.shadows = ShadowMode::Auto;
    }

    Frame draw(const FrameOptions& options = {}) { return model->draw(view, quality, options); }

    std::unique_ptr<DrawnModel> model;
    plan::View view;
    plan::Quality quality;
};

/// The software executor, but for exact shadows: what OpenGL is like.
class MapsAlone final : public executor::Executor {
public:
    std::string name() const override { return own_->name(); }

    executor::PassStatistics drawShadowMaps(const executor::FrameDrawing& frame) override {
        return own_->drawShadowMaps(frame);
    }

    executor::PassStatistics drawImage(const executor::FrameDrawing& frame) override { return own_->drawImage(frame); }

    Bytes deviceMemory() const override { return own_->deviceMemory(); }

    executor::Picture picture() override { return own_->picture(); }

    executor::FloatPicture viewDepth() override { return own_->viewDepth(); }

    executor::FloatPicture shadowDepth() override { return own_->shadowDepth(); }

    executor::Raster<executor::SurfaceSample> surfaces() override { return own_->surfaces(); }

private:
    std::unique_ptr<executor::Executor> own_ = executor::makeSoftwareExecutor();
};

TEST(ShadowMode, LeftOpenIsExactWhereThatIsCheapAndDrawsTheSamePicture) {
    Crate crate;
    const Frame frame = crate.draw();
    EXPECT_EQ(frame.plan.quality.shadows, ShadowMode::Exact);
    EXPECT_EQ(frame.plan.shadowReason, ShadowReason::ExactCostsNoMore);
    EXPECT_EQ(frame.row.shadows, "exact");
    ASSERT_TRUE(frame.row.predictedSampleTests && frame.row.sampleTests);
    EXPECT_GT(*frame.row.predictedSampleTests, 0);
    const executor::Picture picture = crate.model->executor().picture();
    crate.quality.shadows = ShadowMode::Exact;
    const Frame asked = crate.draw();
    EXPECT_EQ(asked.plan.shadowReason, ShadowReason::AskedFor);
    EXPECT_EQ(asked.row.predictedSampleTests, frame.row.predictedSampleTests) << "whoever asks";
    EXPECT_TRUE(crate.model->executor().picture().pixels == picture.pixels);
}

TEST(ShadowMode, IsMapsWhereTheyAreAskedForOrAllThatThereIs) {
    Crate crate;
    FrameOptions options;
    for (const executor::NamedOverlay& overlay : executor::kOverlays) {
        options.overlay = overlay.value;
        const Frame frame = crate.draw(options);
        const bool isOfMaps = executor::isOfMaps(overlay.value);
        EXPECT_EQ(frame.plan.quality.shadows, isOfMaps ? ShadowMode::Maps : ShadowMode::Exact) << overlay.word;
        EXPECT_EQ(frame.row.shadows, isOfMaps ? "maps" : "exact");
        EXPECT_EQ(frame.plan.passes.empty(), !isOfMaps);
        if (isOfMaps) {
            EXPECT_EQ(frame.plan.shadowReason, ShadowReason::MapsAskedFor);
        }
    }
    crate.quality.mapsBecause = ShadowReason::MapsAskedFor;
    EXPECT_EQ(crate.draw().row.shadows, "maps");
    crate.quality.shadows = ShadowMode::Exact;
    EXPECT_EQ(crate.draw().row.shadows, "exact") << "what is asked for by its name is not left open";
    MapsAlone executor;
    Renderer renderer(crate.model->file(), executor, {});
    crate.quality = {};
    crate.quality.shadows = ShadowMode::Auto;
    const Frame frame = renderer.render(crate.view, crate.quality, {});
    EXPECT_EQ(frame.row.shadows, "maps");
    EXPECT_EQ(frame.plan.shadowReason, ShadowReason::ExecutorHasMaps);
    EXPECT_FALSE(frame.row.predictedSampleTests);
}

// Explicit and left open, whatever was drawn before: nothing of a mode stays behind in pictures.
TEST(ShadowMode, OfAFrameLeavesNothingInTheNext) {
    Crate crate;
    crate.quality.shadows = ShadowMode::Maps;
    crate.draw();
    const executor::Picture maps = crate.model->executor().picture();
    crate.quality.shadows = ShadowMode::Auto;
    const Frame exact = crate.draw();
    EXPECT_EQ(exact.row.shadows, "exact");
    crate.quality.shadows = ShadowMode::Maps;
    crate.draw();
    EXPECT_TRUE(crate.model->executor().picture().pixels == maps.pixels);
}

TEST(ShadowMode, WhereNothingFacesTheLightThereIsNoShadowPassAtAll) {
    for (const ShadowMode mode : {ShadowMode::Exact, ShadowMode::Auto}) {
        Crate crate;
        crate.quality.shadows = mode;
        crate.view.towardsLight = {0, -1, 0};
        const Frame dark = crate.draw();
        EXPECT_EQ(dark.row.shadows, "exact");
        const plan::Omission expected{Effect::ExactShadows, OmissionReason::NothingFacesLight};
        EXPECT_EQ(std::count(dark.plan.omitted.begin(), dark.plan.omitted.end(), expected), 1);
        EXPECT_EQ(dark.cut.lists.size(), 1U) << "no caster was looked for";
        EXPECT_EQ(dark.row.shadowSamples, 0);
        EXPECT_EQ(dark.row.castersTested, 0);
        EXPECT_EQ(dark.row.predictedSampleTests, 0);
        const executor::Picture picture = crate.model->executor().picture();
        crate.quality.shadows = ShadowMode::Rays;
        crate.draw();
        EXPECT_TRUE(crate.model->executor().picture().pixels == picture.pixels);
    }
    Crate sky;
    sky.view.camera.target = sky.view.camera.eye + glm::dvec3(0, 1, 0.1);
    const plan::Omission expected{Effect::ExactShadows, OmissionReason::NothingInView};
    const Frame empty = sky.draw();
    EXPECT_EQ(std::count(empty.plan.omitted.begin(), empty.plan.omitted.end(), expected), 1);
}

} // namespace
} // namespace gnomon::frame
