// Exact shadows of views, lights and sizes that break what is naive: each pixel as the plain integer loops have it.
#include "tests/support/made_model.h"
#include "tests/support/sanitizers.h"
#include "tests/validation/exact_stage.h"

#include <array>
#include <functional>

namespace gnomon::validation {
namespace {

/// A view of a model, and how it is drawn.
struct ExactView {
    const char* name;
    std::function<void(const Box& bounds, plan::View& view, plan::Quality& quality, frame::FrameOptions& options)>
        change;
    bool isEmpty = false; // nothing faces the light, or nothing is seen: no sample at all
};

/// From outside, looking slightly down on the model's middle.
plan::View viewOf(const Box& bounds) {
    plan::View view;
    view.width = 90;
    view.height = 90;
    view.camera.target = bounds.center();
    view.towardsLight = {1, 0.3, 0.2};
    view.camera.eye = bounds.center() + glm::length(bounds.extent()) * glm::dvec3(0.06, 0.05, 0.05);
    return view;
}

// NOLINTNEXTLINE(readability-function-size): a table
const std::vector<ExactView>& views() {
    using B = Box;
    using V = plan::View;
    using Q = plan::Quality;
    using O = frame::FrameOptions;
    static const std::vector<ExactView> list = {
        {"one pixel", [](const B&, V& v, Q&, O&) { v.width = v.height = 1; }},
        {"one row", [](const B&, V& v, Q&, O&) { v.width = 131, v.height = 1; }},
        {"one column", [](const B&, V& v, Q&, O&) { v.width = 1, v.height = 131; }},
        {"odd sizes", [](const B&, V& v, Q&, O&) { v.width = 67, v.height = 131; }},
        {"far before what is seen", [](const B& b, V&, Q& q, O&) { q.far = 0.08 * glm::length(b.extent()); }},
        {"near beyond what is seen",
         [](const B& b, V&, Q& q, O&) {
             q.near = 4 * glm::length(b.extent());
             q.far = 5 * glm::length(b.extent());
         }},
        {"a range within what is seen",
         [](const B& b, V&, Q& q, O&) {
             q.near = 0.09 * glm::length(b.extent());
             q.far = 0.1 * glm::length(b.extent());
         }},
        {"light from overhead",
         [](const B&, V& v, Q&, O&) {
             v.towardsLight = {0, 1, 0};
         }},
        {"light from behind the viewer",
         [](const B&, V& v, Q&, O&) { v.towardsLight = v.camera.eye - v.camera.target; }},
        {"light towards the viewer", [](const B&, V& v, Q&, O&) { v.towardsLight = v.camera.target - v.camera.eye; }},
        {"lamp in the middle",
         [](const B& b, V& v, Q&, O&) {
             v.pointLight = {b.center(), 1};
         }},
        {"lamp at the eye",
         [](const B&, V& v, Q&, O&) {
             v.pointLight = {v.camera.eye, 1};
         }},
        {"lamp on the floor",
         [](const B& b, V& v, Q&, O&) {
             v.pointLight = {{b.center().x, b.min.y, b.center().z}, 1};
         }},
        {"lamp beneath",
         [](const B& b, V& v, Q&, O&) {
             v.pointLight = {b.center() - glm::dvec3(0, 9, 0) * b.extent(), 1};
         }},
        {"lamp behind all",
         [](const B& b, V& v, Q&, O&) {
             v.pointLight = {2.0 * b.center() - v.camera.eye, 1};
         }},
        {"lamp a million sizes away",
         [](const B& b, V& v, Q&, O&) {
             v.pointLight = {b.center() + 1e6 * glm::length(b.extent()) * v.towardsLight, 1};
         }},
        {"light along the ground",
         [](const B&, V& v, Q&, O&) {
             v.towardsLight = {1, 0, 0};
         }},
        {"light hardly above the ground",
         [](const B&, V& v, Q&, O&) {
             v.towardsLight = {1, 1e-7, 0.3};
         }},
        {"a light of hardly any length", [](const B&, V& v, Q&, O&) { v.towardsLight *= 1e-30; }},
        {"light from below",
         [](const B&, V& v, Q&, O&) {
             v.towardsLight = {0.1, -1, 0.2};
         }},
        {"inside",
         [](const B& b, V& v, Q&, O&) {
             v.camera.eye = b.min + b.extent() * glm::dvec3(0.45, 0.3, 0.55);
             v.camera.target = b.min + b.extent() * glm::dvec3(0.9, 0.1, 0.2);
         }},
        {"straight down",
         [](const B& b, V& v, Q&, O&) {
             v.camera.eye = b.center() + glm::dvec3(0, 2 * b.extent().y, 0);
             v.camera.up = {0, 0, 1};
         }},
        {"from far away",
         [](const B& b, V& v, Q&, O&) {
             v.camera.eye = b.center() + 20 * glm::length(b.extent()) * glm::dvec3(1, 1, 0);
         }},
        {"a wide angle", [](const B&, V& v, Q&, O&) { v.camera.fovYRadians = 2.8; }},
        {"a narrow angle", [](const B&, V& v, Q&, O&) { v.camera.fovYRadians = 0.02; }},
        {"parallel lines", [](const B&, V& v, Q&, O&) { v.camera.projection = Projection::Orthographic; }},
        {"parallel lines from inside",
         [](const B& b, V& v, Q&, O&) {
             v.camera.projection = Projection::Orthographic;
             v.camera.eye = b.min + b.extent() * glm::dvec3(0.45, 0.3, 0.55);
             v.camera.target = b.min + b.extent() * glm::dvec3(0.46, 0.29, 0.54);
         }},
        {"parallel lines apart by as much as the model is large",
         [](const B& b, V& v, Q&, O&) {
             v.camera.projection = Projection::Orthographic;
             v.camera.eye = b.center() + 60 * glm::length(b.extent()) * glm::dvec3(1, 1, 0);
         }},
        {"parallel lines and a range",
         [](const B& b, V& v, Q& q, O&) {
             v.camera.projection = Projection::Orthographic;
             q.near = 0.09 * glm::length(b.extent());
             q.far = 0.1 * glm::length(b.extent());
         }},
        {"a cap on triangles", [](const B&, V& v, Q& q, O&) { v.width = v.height = 300, q.maxTriangles = 3000; }},
        {"the finest level", [](const B&, V&, Q& q, O&) { q.errorPixels = 0; }},
        {"a coarse level", [](const B&, V&, Q& q, O&) { q.errorPixels = 30; }},
        {"another camera that sees the frame",
         [](const B& b, V& v, Q&, O& o) {
             o.observerCamera = v.camera;
             o.observerCamera->eye = b.center() + b.extent() * glm::dvec3(-1.5, 1, 0.2);
             v.camera.eye = b.min + b.extent() * glm::dvec3(0.5, 0.4, 0.1);
         }},
        {"another camera under the light's slant",
         [](const B& b, V& v, Q&, O& o) {
             v.towardsLight = {1, 0.2, 0};
             o.observerCamera = v.camera;
             o.observerCamera->eye = b.center() + b.extent() * glm::dvec3(0.1, 0.9, -1);
             v.camera.fovYRadians = 0.2;
         }},
        {"nothing in view",
         [](const B& b, V& v, Q&, O&) {
             v.camera.eye = b.center() + glm::length(b.extent()) * glm::dvec3(2, 2, 2);
             v.camera.target = b.center() + glm::length(b.extent()) * glm::dvec3(3, 3, 3);
         },
         true},
    };
    return list;
}

/// Draws each view of the list; nothing differs from the plain loops, and what is empty is what should be.
void expectTrueViews(Stage& stage) {
    for (const ExactView& each : views()) {
        SCOPED_TRACE(each.name);
        plan::View view = viewOf(stage.bounds());
        plan::Quality quality = exactQuality();
        frame::FrameOptions options;
        each.change(stage.bounds(), view, quality, options);
        const frame::PreparedFrame frame = stage.prepare(view, quality);
        if (!frame.isExact()) {
            EXPECT_TRUE(each.isEmpty);
            const Shot shot = stage.draw(frame);
            EXPECT_EQ(shot.exact ? shot.exact->samples : 0, 0U);
            continue;
        }
        const Shot judged = stage.judged(frame, options);
        EXPECT_EQ(judged.wrong, 0U);
        ASSERT_TRUE(judged.exact);
        EXPECT_FALSE(each.isEmpty);
        EXPECT_LE(judged.exact->dark, judged.exact->samples);
        EXPECT_LE(judged.exact->dark, judged.exact->darkWithoutTolerance);
        EXPECT_LE(judged.exact->darkWithoutTolerance - judged.exact->dark, judged.exact->withinTolerance);
        const Shot plain = stage.draw(frame, options);
        EXPECT_TRUE(plain.picture.pixels == judged.picture.pixels);
        EXPECT_EQ(countsOf(plain), countsOf(judged));
    }
}

TEST(ExactViews, AreTrueOfAPlant) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const tests::BuiltFile model("plant", 20000);
    Stage stage(model.file());
    expectTrueViews(stage);
}

// Maps that a frame left are drawn anew after exact shadows, which have none, and what is exact knows of no maps.
TEST(ExactViews, LeaveNothingToTheNextFrame) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const tests::BuiltFile model("planes", 20000);
    const std::unique_ptr<render::Backend> backend = render::makeSoftwareBackend();
    frame::Renderer renderer(model.file(), *backend, {});
    frame::History history;
    using enum plan::ShadowMode;
    constexpr std::array kModes = {Maps, Maps, Exact, Maps, Exact, Exact, Rays, Exact, Off, Exact, Maps, Maps};
    plan::View view = viewOf(model.file().summary().bounds);
    for (std::size_t i = 0; i < kModes.size(); ++i) {
        SCOPED_TRACE(i);
        plan::Quality quality;
        quality.shadows = kModes.at(i);
        quality.stabilize = true;
        quality.warp.rule = shadow::WarpRule::None;
        quality.shadowTexelsWidth = quality.shadowTexelsHeight = 256;
        const frame::Frame frame = renderer.render(view, quality, {}, history);
        history = frame.history;
        const std::unique_ptr<render::Backend> freshBackend = render::makeSoftwareBackend();
        frame::Renderer fresh(model.file(), *freshBackend, {});
        fresh.render(view, quality, {});
        EXPECT_TRUE(backend->picture().pixels == freshBackend->picture().pixels);
        EXPECT_TRUE(backend->viewDepth().pixels == freshBackend->viewDepth().pixels);
        EXPECT_TRUE(backend->shadowDepth().pixels == freshBackend->shadowDepth().pixels);
        if (kModes.at(i) != Maps) continue;
        const bool isReused = i > 0 && kModes.at(i - 1) == Maps;
        EXPECT_GT(frame.row.shadowMaps, 0);
        EXPECT_EQ(frame.row.shadowMapsDrawn, isReused ? 0 : frame.row.shadowMaps);
    }
}

TEST(SlowExactViews, AreTrueOfAStatueAndOfPlanes) {
    for (const char* kind : {"statue", "planes"}) {
        SCOPED_TRACE(kind);
        const tests::BuiltFile model(kind, 20000);
        Stage stage(model.file());
        expectTrueViews(stage);
    }
}

} // namespace
} // namespace gnomon::validation
