// Frames whose kind of shadows is `auto`: which of them are exact, which use maps, and which have none.
#include "tests/support/drawn_model.h"
#include "tests/support/scene_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::frame {
namespace {

using plan::Effect;
using plan::ShadowMode;
using plan::ShadowReason;
using plan::SkipReason;

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

/// The software backend, but for exact shadows: what OpenGL is like.
class MapsAlone final : public render::Backend {
public:
    std::string name() const override { return own_->name(); }

    render::PassStatistics drawShadowMaps(const render::DrawInputs& frame) override {
        return own_->drawShadowMaps(frame);
    }

    render::PassStatistics drawImage(const render::DrawInputs& frame) override { return own_->drawImage(frame); }

    Bytes deviceMemory() const override { return own_->deviceMemory(); }

    render::Picture picture() override { return own_->picture(); }

    render::LightPicture light() override { return own_->light(); }

    std::optional<std::uint64_t> litPixels() override { return own_->litPixels(); }

    render::FloatPicture viewDepth() override { return own_->viewDepth(); }

    render::FloatPicture shadowDepth() override { return own_->shadowDepth(); }

    render::Raster<render::SurfaceSample> surfaces() override { return own_->surfaces(); }

private:
    std::unique_ptr<render::Backend> own_ = render::makeSoftwareBackend();
};

TEST(AutoShadows, AreExactWithTheSoftwareBackendAndDrawTheSamePicture) {
    Crate crate;
    const Frame frame = crate.draw();
    EXPECT_EQ(frame.plan.quality.shadows, ShadowMode::Exact);
    EXPECT_EQ(frame.plan.shadowReason, ShadowReason::BackendIsExact);
    EXPECT_EQ(frame.row.shadows, "exact");
    EXPECT_EQ(frame.row.cullCasters, "") << "of maps that are not there";
    const render::Picture picture = crate.model->backend().picture();
    crate.quality.shadows = ShadowMode::Exact;
    const Frame asked = crate.draw();
    EXPECT_EQ(asked.plan.shadowReason, ShadowReason::Requested);
    EXPECT_TRUE(crate.model->backend().picture().pixels == picture.pixels);
}

TEST(AutoShadows, IsMapsWhereTheyAreAskedForOrAllThatThereIs) {
    Crate crate;
    FrameOptions options;
    for (const render::NamedOverlay& overlay : render::kOverlays) {
        options.overlay = overlay.value;
        const Frame frame = crate.draw(options);
        const bool isOfMaps = render::isOfMaps(overlay.value);
        EXPECT_EQ(frame.plan.quality.shadows, isOfMaps ? ShadowMode::Maps : ShadowMode::Exact) << overlay.word;
        EXPECT_EQ(frame.row.shadows, isOfMaps ? "maps" : "exact");
        EXPECT_EQ(frame.plan.passes.empty(), !isOfMaps);
        if (isOfMaps) {
            EXPECT_EQ(frame.plan.shadowReason, ShadowReason::MapsRequested);
        }
    }
    crate.quality.mapsBecause = ShadowReason::MapsRequested;
    EXPECT_EQ(crate.draw().row.shadows, "maps");
    crate.quality.shadows = ShadowMode::Exact;
    EXPECT_EQ(crate.draw().row.shadows, "exact") << "what is asked for by its name is not left open";
    MapsAlone backend;
    Renderer renderer(crate.model->file(), backend, {});
    crate.quality = {};
    crate.quality.shadows = ShadowMode::Auto;
    const Frame frame = renderer.render(crate.view, crate.quality, {});
    EXPECT_EQ(frame.row.shadows, "maps");
    EXPECT_EQ(frame.plan.shadowReason, ShadowReason::BackendHasMaps);
}

// Explicit and left open, whatever was drawn before: nothing of a mode stays behind in pictures.
TEST(AutoShadows, OfAFrameLeavesNothingInTheNext) {
    Crate crate;
    crate.quality.shadows = ShadowMode::Maps;
    crate.draw();
    const render::Picture maps = crate.model->backend().picture();
    crate.quality.shadows = ShadowMode::Auto;
    const Frame exact = crate.draw();
    EXPECT_EQ(exact.row.shadows, "exact");
    crate.quality.shadows = ShadowMode::Maps;
    crate.draw();
    EXPECT_TRUE(crate.model->backend().picture().pixels == maps.pixels);
}

TEST(AutoShadows, WhereNothingFacesTheLightThereIsNoShadowPassAtAll) {
    for (const ShadowMode mode : {ShadowMode::Exact, ShadowMode::Auto}) {
        Crate crate;
        crate.quality.shadows = mode;
        crate.view.towardsLight = {0, -1, 0};
        const Frame dark = crate.draw();
        EXPECT_EQ(dark.row.shadows, "exact");
        const plan::SkippedEffect expected{Effect::ExactShadows, SkipReason::NothingFacesLight};
        EXPECT_EQ(std::count(dark.plan.omitted.begin(), dark.plan.omitted.end(), expected), 1);
        EXPECT_TRUE(dark.cut.lists.casters.empty()) << "no caster was looked for";
        EXPECT_EQ(dark.row.shadowSamples, 0);
        EXPECT_EQ(dark.row.castersTested, 0);
        const render::Picture picture = crate.model->backend().picture();
        crate.quality.shadows = ShadowMode::Rays;
        crate.draw();
        EXPECT_TRUE(crate.model->backend().picture().pixels == picture.pixels);
    }
    Crate sky;
    sky.view.camera.target = sky.view.camera.eye + glm::dvec3(0, 1, 0.1);
    const plan::SkippedEffect expected{Effect::ExactShadows, SkipReason::NothingInView};
    const Frame empty = sky.draw();
    EXPECT_EQ(std::count(empty.plan.omitted.begin(), empty.plan.omitted.end(), expected), 1);
}

// A light that the rounding puts into the plane of all that is seen: no step may still take it as it was asked for.
TEST(AutoShadows, OfALightThatIsRoundedIntoTheWallsPlaneDecidesNothing) {
    tests::SceneMesh scene;
    scene.addQuad({0, -8, -8}, {0, 16, 0}, {0, 0, 16});
    DrawnModel model(scene.model());
    plan::View view;
    view.camera = {{10, 0.1, 0.2}, {0, 0, 0}, {0, 1, 0}, 1};
    view.width = view.height = 40;
    view.towardsLight = {1e-9, 1, 0};
    plan::Quality quality;
    quality.shadows = ShadowMode::Exact;
    const Frame frame = model.draw(view, quality);
    const plan::SkippedEffect expected{Effect::ExactShadows, SkipReason::NothingFacesLight};
    EXPECT_EQ(std::count(frame.plan.omitted.begin(), frame.plan.omitted.end(), expected), 1);
    EXPECT_EQ(frame.row.shadowSamples, 0);
}

// A plain under a pile of slabs: one of eight casters in the list, which go first, is enough for all samples.
TEST(AutoShadows, CastersStopWhereTheLastSampleIsDark) {
    tests::SceneMesh scene;
    scene.addGround(64, 8);
    for (int slab = 0; slab < 40; ++slab)
        scene.addQuad({-400, 20.0 + slab, -400}, {800, 0, 0}, {0, 0, 800});
    DrawnModel model(scene.model());
    plan::View view;
    view.camera = {{3, 4, 10}, {0, 1, 0}, {0, 1, 0}, 1};
    view.width = view.height = 100;
    view.towardsLight = {0, 1, 0};
    plan::Quality quality;
    quality.shadows = ShadowMode::Exact;
    const Frame frame = model.draw(view, quality);
    EXPECT_GT(*frame.row.shadowSamples, 1000);
    EXPECT_GT(frame.cut.lists.casters[0].clusters, 40U);
    EXPECT_LT(*frame.row.castersTested, static_cast<std::int64_t>(frame.cut.lists.casters[0].clusters) / 4);
    const plan::SkippedEffect late{Effect::LateCasters, SkipReason::AllAreDark};
    EXPECT_EQ(std::count(frame.plan.omitted.begin(), frame.plan.omitted.end(), late), 1);
    quality.shadows = ShadowMode::Off;
    const render::Picture dark = model.backend().picture();
    model.draw(view, quality);
    EXPECT_FALSE(model.backend().picture().pixels == dark.pixels) << "nothing was dark: this tests nothing";
    quality.shadows = ShadowMode::Exact;
    view.towardsLight = {1, 0.02, 0.01}; // from below the slabs
    const std::vector<plan::SkippedEffect> all = model.draw(view, quality).plan.omitted;
    EXPECT_EQ(std::count(all.begin(), all.end(), late), 0);
}

} // namespace
} // namespace gnomon::frame
