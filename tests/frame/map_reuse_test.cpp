// Maps that are not drawn again: only where nothing changed, and with the very bytes of drawing them all.
#include "core/random.h"
#include "frame/renderer.h"
#include "render/gl/gl_backend.h"
#include "render/software_backend.h"
#include "tests/support/tested_platform.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

namespace gnomon::frame {
namespace {

/// Hills far from the origin, as a renderer opens them.
const hierarchy::ModelFile& farHills() {
    static const auto file = [] {
        tests::TinyModelOptions options;
        options.gridExponent = 6;
        options.height = 10;
        options.origin = {1e6, -300, 2e5};
        const auto path =
            std::filesystem::temp_directory_path() / ("gnomon_map_reuse_" + std::to_string(::getpid()) + ".gnm");
        tests::writeModel(tests::makeTinyModel(options), path.string());
        auto model = std::make_unique<hierarchy::ModelFile>(path.string());
        std::filesystem::remove(path); // the open file stays readable
        return model;
    }();
    return *file;
}

plan::View view() {
    const Box& bounds = farHills().summary().bounds;
    plan::View view;
    view.width = view.height = 96;
    view.camera.eye = bounds.min + bounds.extent() * glm::dvec3(0.1, 1.3, 0.1);
    view.camera.target = bounds.center();
    view.towardsLight = {0.5, 0.6, 0.3};
    return view;
}

plan::Quality stabilized() {
    plan::Quality quality;
    quality.warp.rule = shadow::WarpRule::None;
    quality.stabilize = true;
    quality.zPartitions = 3;
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 256;
    return quality;
}

/// Stabilised maps whose casters are the same from anywhere.
plan::Quality steady() {
    plan::Quality quality = stabilized();
    quality.near = 8;
    quality.far = 120;
    quality.errorPixels = 1e-9;
    quality.cullCasters = plan::CasterCulling::Off;
    return quality;
}

void moveBy(plan::View& view, const glm::dvec3& step) {
    view.camera.eye += step;
    view.camera.target += step;
}

/// A renderer that reuses maps beside one that draws each in every frame: all that they show is the same.
class Twins {
public:
    explicit Twins(std::unique_ptr<render::Backend> (*make)())
        : backend_(make()),
          redrawer_(make()),
          renderer_(farHills(), *backend_, {}),
          redrawing_(farHills(), *redrawer_, {}) {}

    /// Draws the frame twice; how many maps the first of them reused.
    int draw(const plan::View& view, const plan::Quality& quality) {
        const Frame frame = renderer_.render(view, quality, {}, history_);
        history_ = frame.history;
        FrameOptions options;
        options.reusesMaps = false;
        const Frame redrawn = redrawing_.render(view, quality, options, redrawnHistory_);
        redrawnHistory_ = redrawn.history;
        EXPECT_EQ(redrawn.row.shadowMapsDrawn, redrawn.row.shadowMaps);
        EXPECT_EQ(frame.row.shadowMaps, redrawn.row.shadowMaps);
        EXPECT_EQ(backend_->shadowDepth().pixels, redrawer_->shadowDepth().pixels);
        EXPECT_EQ(backend_->picture().pixels, redrawer_->picture().pixels);
        int reused = 0;
        for (const plan::ShadowPass& pass : frame.plan.passes)
            reused += pass.isReused ? 1 : 0;
        EXPECT_EQ(frame.row.shadowMapsDrawn + reused, frame.row.shadowMaps);
        maps_ = static_cast<int>(frame.plan.passes.size());
        return reused;
    }

    /// Of the last frame.
    int maps() const { return maps_; }

private:
    std::unique_ptr<render::Backend> backend_;
    std::unique_ptr<render::Backend> redrawer_;
    Renderer renderer_;
    Renderer redrawing_;
    History history_;
    History redrawnHistory_;
    int maps_ = 0;
};

class MapReuse : public testing::TestWithParam<std::unique_ptr<render::Backend> (*)()> {};

TEST_P(MapReuse, StandingStillDrawsNoMapAgain) {
    Twins twins(GetParam());
    EXPECT_EQ(twins.draw(view(), stabilized()), 0);
    ASSERT_GT(twins.maps(), 1);
    for (int frame = 0; frame < 3; ++frame)
        EXPECT_EQ(twins.draw(view(), stabilized()), twins.maps());
}

TEST_P(MapReuse, AMapStaysWhileTheEyeMovesByLessThanItsTexel) {
    Twins twins(GetParam());
    plan::View moving = view();
    twins.draw(moving, steady());
    int reused = 0;
    int drawn = 0;
    for (int frame = 0; frame < 24; ++frame) {
        moveBy(moving, {0.011, 0, 0.017});
        const int kept = twins.draw(moving, steady());
        reused += kept;
        drawn += twins.maps() - kept;
    }
    EXPECT_GT(reused, 24);
    EXPECT_GT(drawn, 3) << "the grid is never crossed: this tests nothing";
}

plan::Quality warped(plan::CasterCulling culling) {
    plan::Quality quality;
    quality.cullCasters = culling;
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 256;
    return quality;
}

/// For how many frames a standing camera draws any map, until depths and orientations have come to rest.
int framesUntilAllStay(Twins& twins, const plan::View& view, const plan::Quality& quality) {
    for (int frame = 0; frame < 100; ++frame)
        if (twins.draw(view, quality) == twins.maps()) return frame;
    return 100;
}

TEST_P(MapReuse, WarpedMapsStayWhileNothingMoves) {
    for (const auto culling : {plan::CasterCulling::On, plan::CasterCulling::Auto, plan::CasterCulling::Off}) {
        Twins twins(GetParam());
        plan::View standing = view();
        EXPECT_EQ(twins.draw(standing, warped(culling)), 0);
        ASSERT_GT(twins.maps(), 1);
        EXPECT_LE(framesUntilAllStay(twins, standing, warped(culling)), 16);
        moveBy(standing, {1e-3, 0, 0});
        EXPECT_EQ(twins.draw(standing, warped(culling)), 0) << "the eye has moved";
        standing.camera.target.y += 0.1;
        EXPECT_EQ(twins.draw(standing, warped(culling)), 0) << "it looks elsewhere";
    }
}

// Maps that hold what an image asked for alone are no good for another image of the same camera and the same maps.
TEST(MapReuseByReceivers, EndsWhereAnotherImageAsks) {
    const auto backend = render::makeSoftwareBackend();
    const auto fresh = render::makeSoftwareBackend();
    Renderer renderer(farHills(), *backend, {});
    Renderer redrawing(farHills(), *fresh, {});
    plan::Quality quality = warped(plan::CasterCulling::Receivers);
    History history;
    History redrawnHistory;
    const auto reused = [&](const FrameOptions& options) {
        const Frame frame = renderer.render(view(), quality, options, history);
        history = frame.history;
        FrameOptions redrawn = options;
        redrawn.reusesMaps = false;
        redrawnHistory = redrawing.render(view(), quality, redrawn, redrawnHistory).history;
        EXPECT_EQ(backend->picture().pixels, fresh->picture().pixels);
        int count = 0;
        for (const plan::ShadowPass& pass : frame.plan.passes)
            count += pass.isReused ? 1 : 0;
        EXPECT_LE(frame.row.shadowMapsDrawn, frame.row.shadowMaps - count) << "some are not looked up at all";
        return count;
    };
    FrameOptions options;
    for (int frame = 0; frame < 16; ++frame)
        reused(options);
    EXPECT_GT(reused(options), 0);
    options.wantsWholeMaps = true;
    EXPECT_EQ(reused(options), 0) << "whole maps are wanted";
    options.wantsWholeMaps = false;
    EXPECT_GT(reused(options), 0) << "whole ones do for anybody";
    options.observerCamera = Camera{view().camera.eye + glm::dvec3(0, 40, 0), view().camera.target, {0, 0, 1}, 1};
    reused(options);
    options.observerCamera.reset();
    EXPECT_EQ(reused(options), 0) << "an observer asked";
    options.overlay = render::Overlay::Texels;
    EXPECT_EQ(reused(options), 0);
    quality.filter = 2;
    EXPECT_EQ(reused(options), 0);
    for (int frame = 0; frame < 16; ++frame) // a changed setting begins anew
        reused(options);
    EXPECT_GT(reused(options), 0);
    options.subpixel = {0.25, -0.375};
    EXPECT_EQ(reused(options), 0) << "its pixels are sampled elsewhere";
}

TEST_P(MapReuse, OtherCastersEndIt) {
    Twins twins(GetParam());
    plan::Quality quality = stabilized();
    quality.errorPixels = 0.5;
    twins.draw(view(), quality);
    quality.errorPixels = 20;
    EXPECT_LT(twins.draw(view(), quality), twins.maps());
    EXPECT_EQ(twins.draw(view(), quality), twins.maps());
    quality.errorPixels = 0.5;
    EXPECT_LT(twins.draw(view(), quality), twins.maps());
}

TEST_P(MapReuse, AnotherLightOrTextureEndsIt) {
    Twins twins(GetParam());
    plan::View lit = view();
    plan::Quality quality = steady();
    twins.draw(lit, quality);
    EXPECT_EQ(twins.draw(lit, quality), twins.maps());
    lit.towardsLight += glm::dvec3(1e-9, 0, 0);
    EXPECT_EQ(twins.draw(lit, quality), twins.maps()) << "rounded, it is the same light";
    lit.towardsLight += glm::dvec3(1e-6, 0, 0);
    EXPECT_EQ(twins.draw(lit, quality), 0);
    EXPECT_EQ(twins.draw(lit, quality), twins.maps());
    quality.filter = 3;
    EXPECT_EQ(twins.draw(lit, quality), 0);
    quality.shadowTexelsWidth = 300;
    EXPECT_EQ(twins.draw(lit, quality), 0);
}

TEST_P(MapReuse, WhatIsDrawnInBetweenEndsIt) {
    Twins twins(GetParam());
    plan::Quality quality = stabilized();
    twins.draw(view(), quality);
    quality.stabilize = false;
    EXPECT_EQ(twins.draw(view(), quality), 0);
    EXPECT_EQ(twins.draw(view(), quality), twins.maps()) << "from the same camera others are reused as well";
    EXPECT_EQ(twins.draw(view(), stabilized()), 0);
    quality.shadows = plan::ShadowMode::Off;
    twins.draw(view(), quality);
    EXPECT_EQ(twins.draw(view(), stabilized()), 0);
    quality.shadows = plan::ShadowMode::Rays;
    twins.draw(view(), quality);
    EXPECT_EQ(twins.draw(view(), stabilized()), 0);
}

/// Whatever happens, no picture shows that maps were reused.
TEST_P(MapReuse, ASeededWalkShowsTheSamePictures) {
    Random random(12);
    Twins twins(GetParam());
    plan::View walking = view();
    plan::Quality quality = steady();
    int reused = 0;
    for (int frame = 0; frame < 60; ++frame) {
        switch (random.below(9)) {
        case 0:
            walking.towardsLight.x += random.uniform(-0.2, 0.2);
            break;
        case 1:
            quality.errorPixels = quality.errorPixels < 1 ? 4 : 1e-9;
            break;
        case 2:
            quality.cullCasters =
                quality.cullCasters == plan::CasterCulling::Off ? plan::CasterCulling::Auto : plan::CasterCulling::Off;
            break;
        case 3:
            quality.stabilize = random.below(4) != 0;
            break;
        case 4: { // turns on the spot
            const double x = random.uniform(-1, 1);
            const double z = random.uniform(-1, 1);
            walking.camera.target += glm::dvec3(x, 0, z);
            break;
        }
        case 5:
            moveBy(walking, {random.uniform(-2, 2), 0, 0});
            break;
        case 6:
            moveBy(walking, {0, random.uniform(-0.01, 0.01), 0});
            break;
        default: // stands still
            break;
        }
        reused += twins.draw(walking, quality);
        if (HasFailure()) FAIL() << "frame " << frame;
    }
    EXPECT_GT(reused, 30) << "this tests nothing";
}

std::unique_ptr<render::Backend> reuseOnOsmesa() {
    return render::makeGlBackend(gl::testedPlatform(), gl::ShaderLibrary(std::nullopt), mebibytes(64));
}

INSTANTIATE_TEST_SUITE_P(Software, MapReuse, testing::Values(&render::makeSoftwareBackend));
INSTANTIATE_TEST_SUITE_P(Osmesa, MapReuse, testing::Values(&reuseOnOsmesa));

} // namespace
} // namespace gnomon::frame
