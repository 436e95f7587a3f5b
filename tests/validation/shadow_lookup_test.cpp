// The shadow test on its own: OpenGL's against plain code over the same maps, and stabilised maps asked at fixed points
// of the world while the camera moves, and the share of them that the log gives as `crawl`.
#include "gl/shader_library.h"
#include "render/frame_block.h"
#include "render/gl/gl_backend.h"
#include "render/software_shading.h"
#include "tests/support/drawn_model.h"
#include "tests/support/field.h"
#include "tests/support/plain_shading.h"
#include "tests/support/scene_mesh.h"
#include "tests/support/tested_platform.h"
#include "validation/frame_validation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::validation {
namespace {

struct Asked {
    std::uint64_t pixels = 0;
    std::uint64_t dark = 0;
    std::uint64_t unlike = 0;
};

void compareLookups(render::Backend& gl, const render::Field& field, std::uint64_t seed, Asked& asked) {
    plan::View view = field.view(seed);
    view.towardsLight.y *= 0.2; // so low that hills shade one another
    const plan::FramePlan plan = field.plan(view, render::fieldQuality(seed));
    render::DrawInputs frame = field.drawing(plan);
    frame.wantsSurfaces = true;
    gl.draw(frame);
    if (plan.passes.empty()) return;
    const render::FloatPicture maps = gl.shadowDepth();
    const render::Shading shading(frame, render::imageClipFromDraw(frame), maps, {});
    const glm::vec3 light = shading.frame().frame->towardsLight;
    const render::Raster<render::SurfaceSample> surfaces = gl.surfaces();
    for (const render::SurfaceSample& surface : surfaces.pixels) {
        if (!surface.isLitSide() || surface.partition() < 0) continue;
        const float cosine = glm::dot(surface.normal, light);
        const float lit =
            render::plainLitFraction(shading.frame(), surface.partition(), surface.position, surface.normal, cosine);
        ++asked.pixels;
        asked.dark += lit < 0.5F ? 1 : 0;
        asked.unlike += std::abs(lit - surface.litFraction()) > 0.01F ? 1 : 0;
    }
}

TEST(ShadowLookup, OfOpenGlIsThatOfPlainCodeOverTheSameMaps) {
    const render::Field field;
    const std::unique_ptr<render::Backend> gl =
        render::makeGlBackend(gl::testedPlatform(), gl::ShaderLibrary(), mebibytes(64));
    Asked asked;
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
        compareLookups(*gl, field, seed, asked);
    EXPECT_GT(asked.dark, 5000U) << "of " << asked.pixels;
    EXPECT_LE(asked.unlike * 10000, asked.pixels) << asked.unlike << " of " << asked.pixels;
}

/// A frame with its maps, ready to be asked anywhere.
class RequestedFrame {
public:
    RequestedFrame(
        frame::Renderer& renderer,
        frame::DrawnModel& model,
        const plan::View& view,
        const plan::Quality& quality,
        const frame::History& history) {
        render::Backend& backend = model.backend();
        frame::FrameOptions options;
        options.wantsSurfaces = true;
        options.wantsWholeMaps = true;
        frame_ = renderer.render(view, quality, options, history);
        ValidationOptions validationOptions;
        validationOptions.measuresCrawl = true;
        crawl_ = validate(renderer, frame_, validationOptions).crawl;
        surfaces_ = backend.surfaces();
        maps_ = backend.shadowDepth();
        drawing_.plan = &frame_.plan;
        drawing_.space = frame_.space;
        drawing_.grid = model.file().summary().grid;
        drawing_.image = &frame_.cut.lists.image;
        shading_ = std::make_unique<render::Shading>(
            drawing_, render::imageClipFromDraw(drawing_), maps_, std::span<render::DrawnCluster>());
    }

    const render::Raster<render::SurfaceSample>& surfaces() const { return surfaces_; }

    const render::CameraRelativeSpace& space() const { return frame_.space; }

    /// The history that the next frame continues.
    const frame::History& history() const { return frame_.history; }

    /// What the validation found since the frame before.
    const std::optional<Crawl>& crawl() const { return crawl_; }

    bool isInView(const glm::vec3& position) const {
        const glm::dvec3 p(frame_.space.cameraFromDraw * glm::dvec4(position, 1));
        const plan::View& view = frame_.plan.view;
        return p.z > 0 && std::abs(p.x / p.z) <= view.tanHalfX() && std::abs(p.y / p.z) <= view.tanHalfY();
    }

    /// The map that a point of camera-relative space asks, and what it answers.
    std::pair<int, float> lit(const glm::vec3& position, const glm::vec3& normal) const {
        const render::ShadingFrame& f = shading_->frame();
        const float depth = glm::dot(f.frame->viewDirection, position) + f.frame->originDepth;
        const int pass = render::plainPassOf(f, position - f.frame->eye, depth);
        if (pass < 0) return {pass, 1.0F};
        return {pass, render::plainLitFraction(f, pass, position, normal, glm::dot(normal, f.frame->towardsLight))};
    }

private:
    frame::Frame frame_;
    std::optional<Crawl> crawl_;
    render::Raster<render::SurfaceSample> surfaces_{0, 0};
    render::FloatPicture maps_{0, 0};
    render::DrawInputs drawing_;
    std::unique_ptr<render::Shading> shading_;
};

/// Of points of the world that two frames after one another show, those that ask the same slice, and what changed.
struct SlowCrawl {
    std::uint64_t points = 0;
    std::uint64_t dark = 0;
    std::uint64_t changed = 0;
};

SlowCrawl crawlBetween(const RequestedFrame& before, const RequestedFrame& now) {
    SlowCrawl crawl;
    const auto cells = [](const hierarchy::GridPoint& p) { return glm::dvec3(p.x, p.y, p.z); };
    const glm::vec3 offset((cells(before.space().originCell) - cells(now.space().originCell)) * before.space().step);
    for (const render::SurfaceSample& surface : before.surfaces().pixels) {
        if (!surface.isLitSide()) continue;
        const auto then = before.lit(surface.position, surface.normal);
        const auto later = now.lit(surface.position + offset, surface.normal);
        if (then.first < 0 || then.first != later.first || !now.isInView(surface.position + offset)) continue;
        ++crawl.points;
        crawl.dark += then.second < 0.5F ? 1 : 0;
        crawl.changed += then.second != later.second ? 1 : 0;
    }
    return crawl;
}

tests::SceneMesh boxesInRows() {
    tests::SceneMesh scene;
    scene.addGround(128, 16);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 6; ++column) {
            const glm::dvec3 corner(5 * column - 13, 0, 5 * row - 13);
            scene.addBox(corner, corner + glm::dvec3(1.7, 1.5 + (6 * row + column) % 5, 1.8));
        }
    return scene;
}

SlowCrawl crawlOfASlowWalk(bool stabilize) {
    frame::DrawnModel model(boxesInRows().model()); // of one level of detail: the cut is frozen
    frame::Renderer renderer(model.file(), model.backend(), {});
    plan::View view;
    view.width = view.height = 128;
    view.towardsLight = {0.5, 1, 0.3};
    plan::Quality quality;
    quality.stabilize = stabilize;
    quality.near = 1;
    quality.far = 96; // behind all that is in view
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 512;
    SlowCrawl crawl;
    std::unique_ptr<RequestedFrame> before;
    for (int frame = 0; frame < 12; ++frame) {
        view.camera.eye = {0.31 + 0.0173 * frame, 3 + 0.004 * frame, 17 - 0.0291 * frame};
        view.camera.target = view.camera.eye + glm::dvec3(0.02 * frame, -2, -10);
        auto now = std::make_unique<RequestedFrame>(
            renderer, model, view, quality, before ? before->history() : frame::History());
        if (before) {
            const SlowCrawl step = crawlBetween(*before, *now);
            EXPECT_EQ(now->crawl()->points, step.points);
            EXPECT_EQ(now->crawl()->changed, step.changed);
            crawl.points += step.points;
            crawl.dark += step.dark;
            crawl.changed += step.changed;
        }
        before = std::move(now);
    }
    return crawl;
}

TEST(StabilisedSlices, AnswerTheSameForFixedPointsWhileTheCameraMoves) {
    const SlowCrawl stable = crawlOfASlowWalk(true);
    EXPECT_GT(stable.points, 50000U);
    EXPECT_GT(stable.dark, 1000U);
    EXPECT_EQ(stable.changed, 0U);
    EXPECT_GT(crawlOfASlowWalk(false).changed, 100U) << "without stabilisation edges crawl";
}

} // namespace
} // namespace gnomon::validation
