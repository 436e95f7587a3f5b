// A picture depends on its view and its settings alone: on no frame before, and on no optimisation.
#include "core/random.h"
#include "tests/support/crate_scene.h"
#include "tests/support/drawn_model.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <functional>

namespace gnomon::frame {
namespace {

using plan::ShadowMode;

/// All that a frame is asked for.
struct Asked {
    plan::View view;
    plan::Quality quality;
    FrameOptions options;
};

/// From four sides of the crate, each a jump from every other.
plan::View viewFrom(std::uint64_t side) {
    constexpr std::array kEyes = {
        glm::dvec3(0, 3, 12), glm::dvec3(11, 5, -2), glm::dvec3(-3, 1, -10), glm::dvec3(-9, 14, 3)};
    plan::View view;
    view.width = 72;
    view.height = 56;
    view.camera.eye = kEyes.at(side);
    view.camera.target = {0, 1, 0};
    view.towardsLight = {0.3, 0.5, -1};
    return view;
}

using Change = std::function<void(Asked&, Random&)>;

/// Every setting that a picture of the crate can depend on, and every option of a frame.
std::vector<Change> changes() {
    const auto flip = [](bool& value) { value = !value; };
    const auto choice = [](Random& r) {
        return std::array{plan::Choice::Off, plan::Choice::On, plan::Choice::Auto}.at(r.below(3));
    };
    return {
        [](Asked& a, Random& r) {
            const plan::View next = viewFrom(r.below(4));
            a.view.camera = next.camera;
        },
        [](Asked& a, Random& r) {
            a.view.towardsLight =
                std::array{glm::dvec3(0.3, 0.5, -1), glm::dvec3(1, 1, 0.2), glm::dvec3(-1, 0.4, 0.6)}.at(r.below(3));
        },
        [](Asked& a, Random& r) { a.view.width = 60 + 4 * static_cast<int>(r.below(6)); },
        [](Asked& a, Random& r) {
            a.view.sections.clear();
            if (r.below(2) == 0) a.view.sections.push_back({{0, -1, 0}, 1.5});
        },
        [=](Asked& a, Random&) { flip(a.view.cutsCasters); },
        [=](Asked& a, Random&) { flip(a.quality.look.ground); },
        [](Asked& a, Random& r) { a.quality.look.shading = plan::kShadings.at(r.below(3)).value; },
        [](Asked& a, Random& r) { a.quality.look.ambient = 0.5 + 0.25 * static_cast<double>(r.below(3)); },
        [](Asked& a, Random& r) {
            constexpr std::array kOthers = {ShadowMode::Off, ShadowMode::Exact, ShadowMode::Rays, ShadowMode::Auto};
            a.quality.shadows = r.below(2) == 0 ? ShadowMode::Maps : kOthers.at(r.below(4));
        },
        [](Asked& a, Random& r) { // culled by receivers more often than not
            a.quality.cullCasters = plan::kCasterCullings.at(r.below(2) == 0 ? 3 : r.below(4)).value;
        },
        [=](Asked& a, Random& r) { a.quality.occlusion = choice(r); },
        [=](Asked& a, Random& r) { a.quality.facePartitions = choice(r); },
        [](Asked& a, Random& r) {
            a.quality.filter = std::array{0, 2, 3}.at(r.below(3));
        },
        [](Asked& a, Random& r) {
            a.quality.zPartitions = std::array{std::optional(1), std::optional(3), std::optional<int>()}.at(r.below(3));
        },
        [](Asked& a, Random& r) {
            a.quality.errorPixels = std::array{0.0, 1.0, 6.0}.at(r.below(3));
        },
        [](Asked& a, Random& r) { a.quality.shadowTexelsWidth = a.quality.shadowTexelsHeight = 128 << r.below(2); },
        [](Asked& a, Random& r) {
            a.quality.stabilize = r.below(3) == 0;
            a.quality.warp.rule = a.quality.stabilize ? shadow::WarpRule::None
                                                      : shadow::kWarpRules.at(r.below(shadow::kWarpRules.size())).value;
        },
        [](Asked& a, Random& r) { a.quality.near = r.below(2) == 0 ? std::nullopt : std::optional(2.5); },
        [](Asked& a, Random& r) {
            a.quality.maxTriangles = r.below(2) == 0 ? std::nullopt : std::optional<std::uint64_t>(400);
        },
        [](Asked& a, Random& r) { a.options.overlay = render::kOverlays.at(r.below(3)).value; },
        [](Asked& a, Random& r) {
            a.options.subpixel = {0.25 * static_cast<double>(r.below(2)), 0};
        },
        [=](Asked& a, Random&) { flip(a.options.wantsSurfaces); },
        [=](Asked& a, Random&) { flip(a.options.wantsWholeMaps); },
        [=](Asked& a, Random&) { flip(a.options.isAccumulated); },
        [](Asked& a, Random& r) {
            a.options.observerCamera.reset();
            if (r.below(3) == 0) a.options.observerCamera = viewFrom(3).camera;
        }};
}

/// Draws `asked` with a renderer that has drawn nothing else.
render::Picture freshPicture(const hierarchy::ModelFile& model, const Asked& asked, const History& history = {}) {
    const auto backend = render::makeSoftwareBackend();
    Renderer(model, *backend, {}).render(asked.view, asked.quality, asked.options, history);
    return backend->picture();
}

int reusedMaps(const Frame& frame) {
    const auto isReused = [](const plan::ShadowPass& pass) { return pass.isReused; };
    return static_cast<int>(std::count_if(frame.plan.passes.begin(), frame.plan.passes.end(), isReused));
}

// One renderer reuses its maps, a second one draws each in every frame, and behind a changed setting a third one has
// seen nothing else.
TEST(Repeatability, NoPictureShowsWhatWasDrawnBefore) {
    DrawnModel model(crateOnGround().model());
    const auto redrawing = render::makeSoftwareBackend();
    Renderer redrawer(model.file(), *redrawing, {});
    const std::vector<Change> all = changes();
    Random random(44);
    Asked asked{viewFrom(0), {}, {}};
    asked.quality.shadowTexelsWidth = asked.quality.shadowTexelsHeight = 128;
    asked.quality.look.shading = plan::Shading::Auto;
    asked.quality.cullCasters = plan::CasterCulling::Receivers;
    History history;
    History redrawn;
    int reused = 0;
    for (int step = 0; step < 180; ++step) {
        const Asked before = asked;
        const std::uint64_t change = random.below(all.size() + 8); // the last ones change nothing
        if (change < all.size()) all[change](asked, random);
        SCOPED_TRACE("step " + std::to_string(step) + ", change " + std::to_string(change));
        const Frame frame = model.renderer().render(asked.view, asked.quality, asked.options, history);
        history = frame.history;
        reused += reusedMaps(frame);
        const render::Picture picture = model.backend().picture();
        Asked anew = asked;
        anew.options.reusesMaps = false;
        redrawn = redrawer.render(anew.view, anew.quality, anew.options, redrawn).history;
        ASSERT_TRUE(picture.pixels == redrawing->picture().pixels) << "reused maps show";
        const bool isFirst = step == 0 || !(before.view == asked.view && before.quality == asked.quality);
        if (isFirst) {
            ASSERT_TRUE(picture.pixels == freshPicture(model.file(), asked).pixels) << "frames before show";
        }
    }
    EXPECT_GT(reused, 40) << "this tests nothing";
}

// One renderer draws a random sequence of frames. Each frame has no history, the last history or an older one. A
// renderer that has drawn nothing else is the slow twin.
TEST(Repeatability, AFrameDependsOnlyOnItsHistory) {
    DrawnModel model(crateOnGround().model());
    const std::vector<Change> all = changes();
    Random random(45);
    Asked asked{viewFrom(0), {}, {}};
    asked.quality.shadowTexelsWidth = asked.quality.shadowTexelsHeight = 128;
    asked.quality.look.shading = plan::Shading::Auto;
    asked.quality.cullCasters = plan::CasterCulling::Receivers;
    std::vector<History> histories(1);
    int reused = 0;
    int unmatched = 0;
    for (int step = 0; step < 160; ++step) {
        if (random.below(2) == 0) all[random.below(all.size())](asked, random);
        const std::uint64_t kind = random.below(4);
        const History history = kind == 0   ? History()
                                : kind == 1 ? histories[random.below(histories.size())]
                                            : histories.back();
        SCOPED_TRACE("step " + std::to_string(step) + ", kind " + std::to_string(kind));
        const Frame frame = model.renderer().render(asked.view, asked.quality, asked.options, history);
        ASSERT_TRUE(model.backend().picture().pixels == freshPicture(model.file(), asked, history).pixels);
        const bool isLast = history.maps && history.maps == histories.back().maps;
        if (!isLast) {
            EXPECT_EQ(reusedMaps(frame), 0) << "the texture holds other maps";
        }
        unmatched += history.maps && !isLast ? 1 : 0;
        reused += reusedMaps(frame);
        histories.push_back(frame.history);
    }
    EXPECT_GT(reused, 20) << "this tests nothing";
    EXPECT_GT(unmatched, 5) << "this tests nothing";
}

// The maps of the frame before lack the casters that its image did not look up.
TEST(Repeatability, CulledMapsServeNoOtherImage) {
    DrawnModel model(crateOnGround().model());
    Random random(1);
    int reused = 0;
    for (const Change& change : changes()) {
        Asked asked{viewFrom(0), {}, {}};
        asked.quality.shadowTexelsWidth = asked.quality.shadowTexelsHeight = 128;
        asked.quality.look.shading = plan::Shading::Lit;
        asked.quality.cullCasters = plan::CasterCulling::Receivers;
        History before;
        for (int frame = 0; frame < 12; ++frame) {
            const Frame drawn = model.renderer().render(asked.view, asked.quality, asked.options, before);
            before = drawn.history;
            reused += !drawn.plan.passes.empty() && drawn.plan.passes[0].isReused ? 1 : 0;
        }
        for (int again = 0; again < 4; ++again) {
            change(asked, random);
            const Frame drawn = model.renderer().render(asked.view, asked.quality, asked.options, before);
            EXPECT_TRUE(model.backend().picture().pixels == freshPicture(model.file(), asked, before).pixels);
            before.maps = drawn.history.maps;
        }
    }
    EXPECT_GT(reused, 10) << "this tests nothing";
}

TEST(Repeatability, AnAccumulatedFrameLeavesNoWiderCut) {
    DrawnModel model(crateOnGround().model());
    const plan::View view = viewFrom(1);
    plan::Quality quality;
    quality.errorPixels = 0.1;
    const auto costAndClusters = [&] {
        const PreparedFrame frame = model.renderer().prepare(view, quality);
        return std::pair(model.renderer().plan(view, quality).cost, frame.cut.lists.image.ranges);
    };
    model.renderer().render(view, quality, {});
    const auto plain = costAndClusters();
    FrameOptions options;
    options.isAccumulated = true;
    model.renderer().render(view, quality, options);
    EXPECT_TRUE(costAndClusters() == plain);
}

/// Draws `asked` with each culling of casters, each occlusion culling, one thread and two, and expects equal pictures.
void expectEqualPictures(const hierarchy::ModelFile& file, Asked asked) {
    std::optional<render::Picture> first;
    for (const auto& culling : plan::kCasterCullings)
        for (const auto& occlusion : plan::kChoices)
            for (const int threads : {1, 2}) {
                asked.quality.cullCasters = culling.value;
                asked.quality.occlusion = occlusion.value;
                tbb::task_arena arena(threads);
                const render::Picture picture = arena.execute([&] { return freshPicture(file, asked); });
                if (!first) first = picture;
                EXPECT_TRUE(picture.pixels == first->pixels) << culling.word << ", " << occlusion.word;
            }
}

// In back light too, where next to nothing that is seen faces the sun.
TEST(Repeatability, NoOptimisationChangesAPicture) {
    DrawnModel model(crateOnGround().model());
    for (const bool hasGround : {false, true}) {
        for (const std::uint64_t side : {std::uint64_t{0}, std::uint64_t{2}}) {
            Asked asked{viewFrom(side), {}, {}};
            asked.view.camera.target.y = 2.4; // little of the plain, which faces the sun
            asked.quality.look.shading = plan::Shading::Auto;
            asked.quality.look.ground = hasGround;
            SCOPED_TRACE(hasGround ? "with ground" : "without ground");
            expectEqualPictures(model.file(), asked);
        }
    }
}

/// A roof over the camera's part of the ground, which the sun does not reach.
plan::View underTheRoof() {
    plan::View view;
    view.camera = {{0, 4, 0}, {0, 0, 0.1}, {0, 1, 0}, 1};
    view.width = view.height = 48;
    view.towardsLight = {0, 1, 0};
    return view;
}

TEST(Repeatability, AGroundThatIsTurnedOnInBackLightIsDrawn) {
    DrawnModel model(crateOnGround().model());
    plan::View view = viewFrom(0);
    view.camera.eye.y = 1.5;
    view.towardsLight = {0.05, 0.002, -1}; // so low that the plain grazes it
    plan::Quality quality;
    quality.look.shading = plan::Shading::Auto;
    for (const ShadowMode mode : {ShadowMode::Maps, ShadowMode::Exact, ShadowMode::Rays}) {
        quality.shadows = mode;
        quality.look.ground = false;
        const History history = model.renderer().render(view, quality, {}).history;
        quality.look.ground = true;
        const Frame frame = model.renderer().render(view, quality, {}, history);
        EXPECT_FALSE(frame.usesHeadlight);
        EXPECT_TRUE(frame.ground);
    }
}

tests::TinyModel roofed() {
    tests::SceneMesh scene;
    scene.addGround(96, 8);
    scene.addBox({-24, 8, -24}, {24, 9, 24});
    return scene.model();
}

// The number of lit pixels decides, before the shading (exact shadows and rays) or with a second image (maps).
TEST(Repeatability, AutoShadesADarkStillWithTheHeadlight) {
    DrawnModel model(roofed());
    for (const ShadowMode mode : {ShadowMode::Maps, ShadowMode::Exact, ShadowMode::Rays}) {
        for (const bool isAccumulated : {false, true}) {
            plan::Quality quality;
            quality.shadows = mode;
            quality.look.shading = plan::Shading::Auto;
            FrameOptions options;
            options.isAccumulated = isAccumulated;
            const Frame frame = model.draw(underTheRoof(), quality, options);
            EXPECT_TRUE(frame.usesHeadlight);
            EXPECT_EQ(frame.history.usesHeadlight, std::optional(true));
            const render::Picture picture = model.backend().picture();
            quality.look.shading = plan::Shading::Headlight;
            EXPECT_FALSE(model.draw(underTheRoof(), quality, options).history.usesHeadlight);
            EXPECT_TRUE(model.backend().picture().pixels == picture.pixels);
        }
    }
}

// A camera that walks out from under a roof, and back.
TEST(Repeatability, AWalkKeepsItsShading) {
    DrawnModel model(roofed());
    plan::Quality quality;
    quality.look.shading = plan::Shading::Auto;
    for (const double start : {16.0, 32.0}) {
        plan::View view = underTheRoof();
        view.camera.eye.x = view.camera.target.x = start;
        const Frame first = model.draw(view, quality);
        const bool usesHeadlight = first.usesHeadlight;
        History history = first.history;
        EXPECT_EQ(usesHeadlight, start < 24);
        for (int step = 0; step < 32; ++step) {
            const double x = start < 24 ? start + 0.5 * step : start - 0.5 * step;
            view.camera.eye.x = view.camera.target.x = x;
            const Frame frame = model.renderer().render(view, quality, {}, history);
            history = frame.history;
            EXPECT_EQ(frame.usesHeadlight, usesHeadlight) << x;
        }
    }
}

} // namespace
} // namespace gnomon::frame
