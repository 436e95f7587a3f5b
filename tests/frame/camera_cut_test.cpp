// What is left of the frames before: nothing behind a jump of the camera, and all of it from step to step of a motion.
#include "core/random.h"
#include "plan/camera_cut.h"
#include "tests/support/drawn_model.h"
#include "tests/support/made_model.h"
#include "tests/support/sanitizers.h"
#include "tests/support/scene_mesh.h"

#include <gtest/gtest.h>

#include <functional>

namespace gnomon::frame {
namespace {

glm::dvec3 turnedBy(double degrees) {
    const double radians = radiansFromDegrees(degrees);
    return {std::sin(radians), 0, -std::cos(radians)};
}

TEST(CameraCut, IsWhatTheTableSays) {
    struct Row {
        const char* what;
        bool isCut;
        std::function<void(plan::View&)> change;
    };

    constexpr double kFarthest = 40;
    const auto moved = [](double by) { return [by](plan::View& v) { v.camera.eye.y += by, v.camera.target.y += by; }; };
    const auto turned = [](double by) { return [by](plan::View& v) { v.camera.target = turnedBy(by); }; };
    const auto rolled = [](double by) {
        return [by](plan::View& v) {
            v.camera.up = {std::sin(radiansFromDegrees(by)), std::cos(radiansFromDegrees(by)), 0};
        };
    };
    const auto lit = [](double by) { return [by](plan::View& v) { v.towardsLight = turnedBy(by); }; };
    const auto zoomed = [](double by) {
        return [by](plan::View& v) { v.camera.fovYRadians = 2 * std::atan(by * std::tan(0.5)); };
    };
    for (const Row& row : std::vector<Row>{
             {"nothing", false, [](plan::View&) {}},
             {"a larger picture", false, [](plan::View& v) { v.width = v.height = 1600; }},
             {"a step", false, moved(9.9)},
             {"a leap", true, moved(10.1)},
             {"a look aside", false, turned(29)},
             {"a turn", true, turned(31)},
             {"a tilt", false, rolled(29)},
             {"a roll", true, rolled(31)},
             {"half an hour", false, lit(29)},
             {"another hour", true, lit(31)},
             {"a little nearer", false, zoomed(0.81)},
             {"through a lens", true, zoomed(0.79)},
             {"and back", true, zoomed(1.26)},
             {"by parallel lines", true, [](plan::View& v) { v.camera.projection = Projection::Orthographic; }},
             {"a lamp", true, [](plan::View& v) { v.pointLight.emplace(); }}}) {
        plan::View before;
        before.camera.fovYRadians = 1;
        before.towardsLight = turnedBy(0);
        plan::View now = before;
        row.change(now);
        EXPECT_EQ(plan::isCameraCut(before, kFarthest, now), row.isCut) << row.what;
        EXPECT_EQ(plan::isCameraCut(now, kFarthest, before), row.isCut) << row.what << ", the other way";
    }
    plan::View before;
    plan::View now = before;
    EXPECT_FALSE(plan::isCameraCut(before, 0, now)) << "nothing was seen, and nothing moved";
    moved(1e-9)(now);
    EXPECT_TRUE(plan::isCameraCut(before, 0, now)) << "it may see anything now";
    before.camera = {{0, 0, 8}, {0, 0, 0}, {0, 1, 0}, 1, Projection::Orthographic};
    for (const auto& [by, isCut] : {std::pair{1.9, false}, {2.1, true}}) {
        now = before;
        moved(by)(now);
        EXPECT_EQ(plan::isCameraCut(before, 1e6, now), isCut) << "by parallel lines only the target's distance counts";
    }
}

/// A view of a model in `bounds` from anywhere around or within, towards about its middle.
plan::View anyView(Random& random, const Box& bounds) {
    const glm::dvec3 half = bounds.extent() * 0.5;
    const auto place = [&](double max) {
        return bounds.center() +
               max * half * glm::dvec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    };
    plan::View view;
    view.width = 96;
    view.height = 72;
    view.camera = {place(1.6), place(0.4), {0, 1, 0}, random.uniform(0.4, 1.5)};
    view.towardsLight = {random.uniform(-1, 1), random.uniform(0.1, 1), random.uniform(-1, 1)};
    return view;
}

/// Shadows of every kind, and with whatever a plan keeps from frame to frame left to it.
plan::Quality anyQuality(Random& random) {
    plan::Quality quality;
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 256;
    quality.shadows = random.below(2) == 0 ? plan::ShadowMode::Maps : plan::ShadowMode::Auto;
    quality.look.shading = plan::Shading::Auto;
    switch (random.below(4)) {
    case 0:
        quality.zPartitions.reset();
        break;
    case 1:
        quality.warp.rule = shadow::WarpRule::Log;
        quality.zPartitions = 1;
        break;
    case 2:
        quality.stabilize = true;
        quality.warp.rule = shadow::WarpRule::None;
        break;
    default:
        break;
    }
    return quality;
}

/// Walks `model` from a random place for a while, jumps, and holds the frame behind the jump against that of a
/// renderer that has seen nothing else. How many frames would have been others with what came before.
int expectNothingAfterCuts(const hierarchy::ModelFile& model, int walks, std::uint64_t seed) {
    Random random(seed);
    const Box& bounds = model.summary().bounds;
    const double radius = glm::length(bounds.extent()) / 2;
    const auto backend = render::makeSoftwareBackend();
    const auto freshBackend = render::makeSoftwareBackend();
    const auto keepingBackend = render::makeSoftwareBackend();
    int others = 0;
    for (int walk = 0; walk < walks; ++walk) {
        SCOPED_TRACE("walk " + std::to_string(walk));
        const plan::Quality quality = anyQuality(random);
        Renderer renderer(model, *backend, {});
        plan::View view = anyView(random, bounds);
        std::optional<Frame> last;
        for (std::uint64_t frames = 1 + random.below(14); frames > 0; --frames) {
            last.emplace(renderer.render(view, quality, {}, last ? last->history : History()));
            view.camera.eye += radius * 0.01 * glm::dvec3{random.uniform(-1, 1), 0, random.uniform(-1, 1)};
        }
        const double farthest = last->facts.visible->farthest;
        plan::View cut = view;
        while (!plan::isCameraCut(last->plan.view, farthest, cut))
            cut = anyView(random, bounds);
        Renderer fresh(model, *freshBackend, {});
        const Frame asFirst = fresh.render(cut, quality, {});
        const Frame behind = renderer.render(cut, quality, {}, last->history);
        EXPECT_EQ(behind.plan.quality.shadows, asFirst.plan.quality.shadows);
        EXPECT_EQ(behind.usesHeadlight, asFirst.usesHeadlight);
        EXPECT_EQ(behind.plan.near, asFirst.plan.near);
        EXPECT_EQ(behind.plan.aliasingBound.worst(), asFirst.plan.aliasingBound.worst());
        EXPECT_TRUE(backend->picture().pixels == freshBackend->picture().pixels);
        Renderer keeps(model, *keepingBackend, {});
        const PreparedFrame kept = keeps.prepare(cut, quality, Waiting::UntilComplete, last->memory);
        others += kept.plan.near != asFirst.plan.near || kept.plan.passes.size() != asFirst.plan.passes.size() ? 1 : 0;
    }
    return others;
}

TEST(CameraCut, LeavesNothingOfTheFramesBefore) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const tests::BuiltFile plant("plant", 20000);
    const tests::BuiltFile statue("statue", 8000);
    EXPECT_GT(expectNothingAfterCuts(plant.file(), 30, 1), 8) << "there was nothing to forget";
    EXPECT_GT(expectNothingAfterCuts(statue.file(), 20, 2), 3) << "there was nothing to forget";
}

// Under a roof, looking down at dark ground, and then along it at a strip in the sun that is too little to bring light
// back and enough not to lose it: it is as light as if nothing had been seen before.
TEST(CameraCut, LeavesTheLightOfARoomBehind) {
    tests::SceneMesh scene;
    scene.addGround(96, 8);
    scene.addBox({-24, 8, -24}, {24, 9, 24});
    DrawnModel model(scene.model());
    plan::View down;
    down.camera = {{0, 4, 0}, {0, 0, 0.1}, {0, 1, 0}, 1};
    down.width = down.height = 80;
    down.towardsLight = {0, 1, 0};
    plan::Quality quality;
    quality.look.shading = plan::Shading::Auto;
    plan::View strip = down;
    const auto litShare = [&] {
        model.draw(strip, quality);
        return static_cast<double>(model.backend().litPixels().value_or(0)) / (80 * 80);
    };
    double height = -16; // at which it looks, where the ground in the sun begins: that is at the upper edge then
    do
        strip.camera.target = {24, height += 0.1, 0};
    while (height < -10 && (litShare() < 0.007 || litShare() > 0.018));
    ASSERT_LT(height, -10);
    EXPECT_FALSE(model.draw(strip, quality).usesHeadlight);
    const render::Picture sunny = model.backend().picture();
    const Frame dark = model.draw(down, quality);
    EXPECT_TRUE(dark.usesHeadlight);
    EXPECT_FALSE(model.renderer().render(strip, quality, {}, dark.history).usesHeadlight);
    EXPECT_TRUE(model.backend().picture().pixels == sunny.pixels);
}

} // namespace
} // namespace gnomon::frame
