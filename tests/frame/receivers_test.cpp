// Casters culled by receivers against all casters: every picture is the same to the bit, whatever is looked up.
#include "core/random.h"
#include "render/image_pass.h"
#include "render/software/receiver_pass.h"
#include "render/software_backend.h"
#include "tests/support/crate_scene.h"
#include "tests/support/drawn_model.h"
#include "tests/support/made_model.h"
#include "tests/support/shadow_triples.h"

#include <gtest/gtest.h>

#include <cstring>

namespace gnomon::frame {
namespace {

using plan::CasterCulling;

/// What was drawn of a view, and what it took.
struct Shot {
    render::Picture picture;
    render::Raster<render::SurfaceSample> surfaces;
    telemetry::FrameRow row;
};

class Camera {
public:
    explicit Camera(const hierarchy::ModelFile& model) : renderer_(model, *backend_, {}) {}

    Shot shoot(const plan::View& view, plan::Quality quality, CasterCulling culling, const FrameOptions& options = {}) {
        quality.cullCasters = culling;
        Shot shot;
        shot.row = renderer_.render(view, quality, options).row;
        shot.picture = backend_->picture();
        shot.surfaces = backend_->surfaces();
        return shot;
    }

private:
    std::unique_ptr<render::Backend> backend_ = render::makeSoftwareBackend();
    Renderer renderer_;
};

bool areSame(const render::Raster<render::SurfaceSample>& a, const render::Raster<render::SurfaceSample>& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(render::SurfaceSample)) == 0;
}

/// Triangles that the maps of a triple drew, under each culling.
struct DrawnTriangles {
    std::int64_t off = 0;
    std::int64_t on = 0;
    std::int64_t receivers = 0;
};

DrawnTriangles expectSamePictures(Camera& camera, const tests::ShadowTriple& triple, render::Overlay overlay) {
    const auto shoot = [&](CasterCulling culling, const FrameOptions& options) {
        return camera.shoot(triple.view, triple.quality, culling, options);
    };
    const Shot off = shoot(CasterCulling::Off, {});
    const Shot on = shoot(CasterCulling::On, {});
    const Shot receivers = shoot(CasterCulling::Receivers, {});
    EXPECT_TRUE(receivers.picture.pixels == on.picture.pixels);
    EXPECT_TRUE(receivers.picture.pixels == off.picture.pixels);
    EXPECT_TRUE(shoot(CasterCulling::Auto, {}).picture.pixels == on.picture.pixels);
    FrameOptions more;
    more.overlay = overlay;
    more.wantsSurfaces = true;
    const Shot onMore = shoot(CasterCulling::On, more);
    const Shot receiversMore = shoot(CasterCulling::Receivers, more);
    EXPECT_TRUE(receiversMore.picture.pixels == onMore.picture.pixels);
    EXPECT_TRUE(areSame(receiversMore.surfaces, onMore.surfaces));
    // A view that the sun does not reach is drawn again by the headlight. That drawing reuses whole maps: none counts.
    if (on.row.shadowMapsDrawn == 0) return {};
    return {
        off.row.shadowTriangles.value_or(0),
        on.row.shadowTriangles.value_or(0),
        receivers.row.shadowTriangles.value_or(0)};
}

/// The pictures of `count` triples of a made model; what their maps drew together.
DrawnTriangles expectSamePictures(const tests::BuiltFile& model, std::uint64_t count, int side) {
    Camera camera(model.file());
    DrawnTriangles all;
    for (std::uint64_t index = 0; index < count; ++index) {
        tests::ShadowTriple triple = tests::shadowTriple(model.file().summary().bounds, index, side, 1200);
        if (index % 3 == 2) {
            triple.quality.warp = {};
            triple.quality.warp.rule = shadow::WarpRule::Log;
        }
        SCOPED_TRACE(std::to_string(index) + ": " + tests::describe(triple));
        constexpr std::array kKinds = {
            render::Overlay::None, render::Overlay::Partitions, render::Overlay::Texels, render::Overlay::Lod};
        const DrawnTriangles drawn = expectSamePictures(camera, triple, kKinds[index % kKinds.size()]);
        EXPECT_LE(drawn.receivers, drawn.on);
        all.off += drawn.off;
        all.on += drawn.on;
        all.receivers += drawn.receivers;
    }
    return all;
}

TEST(Receivers, PicturesOfAPlantAreThoseOfAllCasters) {
    const tests::BuiltFile plant("plant", 20'000);
    const DrawnTriangles drawn = expectSamePictures(plant, 20, 72);
    EXPECT_LT(drawn.on, drawn.off);
    EXPECT_LT(drawn.receivers * 10, drawn.on * 9) << "hardly anything was culled";
}

TEST(SlowReceivers, PicturesOfMadeModelsAreThoseOfAllCasters) {
    for (const char* kind : {"plant", "statue", "planes"}) {
        SCOPED_TRACE(kind);
        const tests::BuiltFile model(kind, 60'000);
        expectSamePictures(model, 60, 160);
    }
}

TEST(Receivers, NothingIsDrawnForAViewThatNoLightReaches) {
    tests::SceneMesh scene;
    scene.addQuad({-20, 0, -20}, {40, 0, 0}, {0, 0, 40});
    scene.addBox({-1, -3, -1}, {1, -2, 1}); // under the ground, seen from below
    DrawnModel model(scene.model());
    plan::View view = overGround();
    view.camera.eye = {0, -8, 6};
    view.towardsLight = {0, 1, 0};
    plan::Quality quality = inSlices(2);
    quality.cullCasters = CasterCulling::Receivers;
    const Frame frame = model.draw(view, quality);
    quality.cullCasters = CasterCulling::On;
    const render::Picture picture = model.backend().picture();
    const Frame whole = model.draw(view, quality);
    EXPECT_TRUE(picture.pixels == model.backend().picture().pixels);
    EXPECT_LE(frame.row.shadowTriangles.value_or(0), whole.row.shadowTriangles.value_or(0));
}

TEST(Receivers, WhoLooksOnFromElsewhereSeesTheSame) {
    DrawnModel model(crateOnGround().model());
    FrameOptions options;
    options.observerCamera = overGround().camera;
    options.observerCamera->eye += glm::dvec3(9, 4, -3);
    plan::Quality quality = inSlices(3);
    quality.cullCasters = CasterCulling::On;
    model.draw(overGround(), quality, options);
    const render::Picture picture = model.backend().picture();
    quality.cullCasters = CasterCulling::Receivers;
    EXPECT_EQ(model.draw(overGround(), quality, options).row.cullCasters, "receivers");
    EXPECT_TRUE(picture.pixels == model.backend().picture().pixels);
}

TEST(Receivers, WholeMapsAreDrawnForWhoLooksAtThem) {
    DrawnModel model(crateOnGround().model());
    plan::Quality quality = inSlices(3);
    quality.cullCasters = CasterCulling::On;
    model.draw(overGround(), quality);
    const render::FloatPicture maps = model.backend().shadowDepth();
    quality.cullCasters = CasterCulling::Receivers;
    FrameOptions options;
    options.wantsWholeMaps = true;
    const Frame frame = model.draw(overGround(), quality, options);
    EXPECT_EQ(frame.row.cullCasters, "on");
    EXPECT_TRUE(model.backend().shadowDepth().pixels == maps.pixels);
}

// What receivers of one view left in a map is no map for another view, nor for a frame that culls otherwise.
TEST(Receivers, NoMapOfOtherReceiversIsReused) {
    const DrawnModel model(crateOnGround().model());
    const std::array backends = {render::makeSoftwareBackend(), render::makeSoftwareBackend()};
    Renderer reusing(model.file(), *backends[0], {});
    Renderer redrawing(model.file(), *backends[1], {});
    History reused;
    History redrawn;
    FrameOptions anew;
    anew.reusesMaps = false;
    Random random(5);
    plan::View view = overGround();
    plan::Quality quality = inSlices(3);
    for (int step = 0; step < 80; ++step) {
        SCOPED_TRACE(step);
        if (random.below(2) == 0) view.camera.target.x += 0.3;
        if (random.below(4) == 0) view.camera.eye.x += 0.05;
        quality.cullCasters = random.below(3) == 0 ? CasterCulling::On : CasterCulling::Receivers;
        quality.stabilize = random.below(2) == 0;
        quality.filter = random.below(3) == 0 ? 3 : 0;
        FrameOptions options;
        if (random.below(4) == 0) options.observerCamera = view.camera;
        if (options.observerCamera) options.observerCamera->eye.y += 2;
        options.wantsWholeMaps = random.below(5) == 0;
        options.wantsSurfaces = random.below(5) == 0;
        anew.observerCamera = options.observerCamera;
        reused = reusing.render(view, quality, options, reused).history;
        redrawn = redrawing.render(view, quality, anew, redrawn).history;
        EXPECT_TRUE(backends[0]->picture().pixels == backends[1]->picture().pixels);
    }
}

} // namespace
} // namespace gnomon::frame
