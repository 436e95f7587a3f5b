// Scenes in words, and the effects that a frame's plan keeps and drops in each.
#include "settings/plan_sentences.h"
#include "tests/support/drawn_model.h"
#include "tests/support/scene_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace gnomon::frame {
namespace {

using tests::SceneMesh;

using plan::Effect;

/// An effect, and of which slice it is.
struct Part {
    // NOLINTNEXTLINE(google-explicit-constructor): a row lists effects, most of them of no slice
    Part(Effect whole, std::size_t ofSlice = 0) : effect(whole), slice(ofSlice) {}

    Effect effect;
    std::size_t slice;
};

/// A scene, who looks at it how, and what the plan must make of it.
struct Row {
    const char* words;
    std::function<void(SceneMesh&)> build;
    std::function<void(plan::View&, plan::Quality&)> look;
    std::vector<Part> kept;
    std::vector<Part> dropped;
};

void plain(SceneMesh& scene) {
    scene.addGround(64, 8);
}

void crateOnPlain(SceneMesh& scene) {
    plain(scene);
    scene.addBox({-1, 0, -1}, {1, 2, 1});
}

void wall(SceneMesh& scene) {
    scene.addQuad({-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
}

void cratesNearAndFar(SceneMesh& scene) {
    scene.addBox({-1, 0, 7}, {1, 2, 8});
    scene.addBox({-8, 0, -95}, {8, 12, -90});
}

void rowOfCrates(SceneMesh& scene) {
    scene.addGround(512, 32);
    for (int i = 0; i < 60; ++i)
        scene.addBox({-1, 0, 6.0 - 4 * i}, {1, 2, 7.0 - 4 * i});
}

using plan::Quality;
using plan::View;

void noon(View& view, Quality&) {
    view.towardsLight = {0, 1, 0};
}

const std::vector<Row>& rows() { // NOLINT(readability-function-size): a table
    static const std::vector<Row> table = {
        {"a bare plain at noon: nothing stands between it and the sun", plain, noon, {}, {Effect::ShadowMaps}},
        {"a crate on the plain at noon",
         crateOnPlain,
         noon,
         {Effect::ShadowMaps, Effect::Warp, Effect::ZPartitions, Effect::PartitionCulling},
         {Effect::FacePartitions, Effect::Stabilization, Effect::Filter}},
        {"a bare plain, the sun below the horizon",
         plain,
         [](View& view, Quality&) {
             view.towardsLight = {0.3, -1, 0.2};
         },
         {},
         {Effect::ShadowMaps}},
        {"a crate on the plain from above, the sun straight below: no side that is seen faces it",
         crateOnPlain,
         [](View& view, Quality&) {
             view.camera.eye.y = 4;
             view.towardsLight = {0, -1, 0};
         },
         {},
         {Effect::ShadowMaps}},
        {"a wall filling the view, the sun behind the viewer",
         wall,
         [](View& view, Quality&) {
             view.camera.target = {0, 2, 0};
             view.towardsLight = {0.1, 0.3, 1};
         },
         {},
         {Effect::ShadowMaps}},
        {"a wall filling the view, the sun behind the wall",
         wall,
         [](View& view, Quality&) {
             view.camera.target = {0, 2, 0};
             view.towardsLight = {0.1, 0.3, -1};
         },
         {},
         {Effect::ShadowMaps}},
        {"a wall filling the view, a crate behind the viewer between it and the sun",
         [](SceneMesh& scene) {
             wall(scene);
             scene.addBox({-1, 6, 20}, {1, 8, 22});
         },
         [](View& view, Quality&) {
             view.camera.target = {0, 2, 0};
             view.towardsLight = {0, 0.3, 1};
         },
         {Effect::ShadowMaps, Effect::DepthClamp},
         {}},
        {"the sky alone",
         crateOnPlain,
         [](View& view, Quality&) { view.camera.target = view.camera.eye + glm::dvec3(0, 1, 0.1); },
         {},
         {Effect::ShadowMaps}},
        {"shadows switched off",
         crateOnPlain,
         [](View&, Quality& quality) { quality.shadows = plan::ShadowMode::Off; },
         {},
         {Effect::ShadowMaps}},
        {"ray-traced shadows",
         crateOnPlain,
         [](View&, Quality& quality) { quality.shadows = plan::ShadowMode::Rays; },
         {},
         {Effect::ShadowMaps}},
        {"a crate near, one far, nothing between",
         cratesNearAndFar,
         [](View& view, Quality&) {
             view.towardsLight = {0.3, 1, 0.5};
         },
         {Effect::ShadowMaps, Part{Effect::MapOfSlice, 0}, Part{Effect::MapOfSlice, 3}},
         {Part{Effect::MapOfSlice, 1}, Part{Effect::MapOfSlice, 2}}},
        {"one slice asked for",
         crateOnPlain,
         [](View&, Quality& quality) { quality.zPartitions = 1; },
         {Effect::ShadowMaps},
         {Effect::ZPartitions}},
        {"the sun exactly behind the viewer: there is no depth to warp",
         cratesNearAndFar,
         [](View& view, Quality&) {
             view.camera.target = view.camera.eye - glm::dvec3(0, 0, 1);
             view.towardsLight = {0, 0, 1};
         },
         {Effect::ShadowMaps},
         {Effect::Warp}},
        {"no warp asked for",
         crateOnPlain,
         [](View&, Quality& quality) { quality.warp.rule = shadow::WarpRule::None; },
         {Effect::ShadowMaps, Effect::ZPartitions},
         {Effect::Warp}},
        {"stabilised slices",
         crateOnPlain,
         [](View&, Quality& quality) { quality.stabilize = true; },
         {Effect::ShadowMaps, Effect::Stabilization},
         {Effect::Warp, Effect::Orientation, Effect::FacePartitions}},
        {"faces asked for, the sun overhead",
         crateOnPlain,
         [](View& view, Quality& quality) {
             view.towardsLight = {0, 1, 0};
             quality.facePartitions = plan::Choice::On;
         },
         {Effect::ShadowMaps, Effect::FacePartitions},
         {Effect::Orientation}},
        {"faces left open, stabilised slices",
         crateOnPlain,
         [](View&, Quality& quality) {
             quality.stabilize = true;
             quality.facePartitions = plan::Choice::Auto;
         },
         {Effect::ShadowMaps},
         {Effect::FacePartitions}},
        {"culling switched off",
         crateOnPlain,
         [](View&, Quality& quality) { quality.cullCasters = plan::CasterCulling::Off; },
         {Effect::ShadowMaps},
         {Effect::PartitionCulling}},
        {"a filter asked for",
         crateOnPlain,
         [](View&, Quality& quality) { quality.filter = 3; },
         {Effect::ShadowMaps, Effect::Filter},
         {}},
        {"a crate in the middle of the view, seen from a crane: all casters lie within the view",
         crateOnPlain,
         [](View& view, Quality&) {
             view.camera.eye = {0, 20, 20};
             view.camera.target = {0, 0, 0};
             view.camera.fovYRadians = 0.6;
             view.towardsLight = {0.2, 1, 0.1};
         },
         {Effect::ShadowMaps},
         {Effect::DepthClamp}},
        {"a beam high over the viewer whose shadow falls into the view",
         [](SceneMesh& scene) {
             plain(scene);
             scene.addBox({-20, 300, -1}, {20, 301, 1});
         },
         noon,
         {Effect::ShadowMaps, Effect::DepthClamp},
         {}},
        {"a promise that one map keeps",
         crateOnPlain,
         [](View&, Quality& quality) {
             quality.zPartitions.reset();
             quality.maxAliasing = 50;
         },
         {Effect::ShadowMaps},
         {Effect::ZPartitions, Effect::FacePartitions}},
        {"a long row of crates, and a promise that one map of even rows cannot keep",
         rowOfCrates,
         [](View& view, Quality& quality) {
             view.towardsLight = {0.3, 1, 0.2};
             quality.zPartitions.reset();
             quality.warp.rule = shadow::WarpRule::Lspsm;
             quality.maxAliasing = 4;
         },
         {Effect::ShadowMaps, Effect::ZPartitions, Effect::Warp},
         {}},
        {"the same with the warp left open: one map of logarithmic rows keeps it",
         rowOfCrates,
         [](View& view, Quality& quality) {
             view.towardsLight = {0.3, 1, 0.2};
             quality.zPartitions.reset();
             quality.maxAliasing = 4;
         },
         {Effect::ShadowMaps, Effect::Warp, Effect::LogRows},
         {Effect::ZPartitions}}};
    return table;
}

bool isDropped(const plan::FramePlan& plan, const Part& part) {
    return std::any_of(plan.omitted.begin(), plan.omitted.end(), [&](const plan::SkippedEffect& skipped) {
        return skipped.effect == part.effect && skipped.slice == part.slice;
    });
}

std::string words(const Part& part) {
    return settings::effectInWords({part.effect, {}, part.slice});
}

std::string told(const plan::FramePlan& plan) {
    std::string text;
    for (const plan::SkippedEffect& skipped : plan.omitted)
        text += settings::effectInWords(skipped) + ": " + settings::reasonInWords(skipped) + "\n";
    return text;
}

/// Nothing of a shadow pass is paid for: no map, no texel, no query, no draw, no memory.
void expectNoCost(const Frame& frame, const Frame& withoutShadows, render::Backend& backend) {
    EXPECT_TRUE(frame.plan.passes.empty());
    EXPECT_EQ(frame.plan.textureWidth * frame.plan.textureHeight, 0);
    EXPECT_EQ(frame.plan.cost, 0U);
    EXPECT_TRUE(frame.cut.lists.casters.empty()) << "a list of casters was made";
    EXPECT_EQ(frame.row.shadowMaps, 0);
    EXPECT_EQ(frame.row.shadowMapsDrawn, 0);
    EXPECT_EQ(frame.row.shadowTriangles, 0);
    EXPECT_EQ(frame.row.castersTested, 0);
    EXPECT_EQ(frame.row.castersKept, 0);
    EXPECT_TRUE(backend.shadowDepth().pixels.empty());
    EXPECT_EQ(frame.row.drawCalls, withoutShadows.row.drawCalls);
    EXPECT_EQ(frame.row.gpuBytes, withoutShadows.row.gpuBytes);
}

View viewOf(const Row& row, Quality& quality) {
    View view;
    view.width = view.height = 96;
    view.camera.eye = {0, 1.7, 10};
    view.camera.target = {0, 1, 0};
    view.towardsLight = {0.5, 1, 0.4};
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 512;
    row.look(view, quality);
    return view;
}

/// A row's scene and what it is drawn with.
struct RowScene {
    explicit RowScene(const Row& row) : view(viewOf(row, quality)) { row.build(scene); }

    SceneMesh scene;
    Quality quality;
    const View view;
};

TEST(SceneTable, KeepsAndDropsWhatItSays) {
    EXPECT_GE(rows().size(), 20U);
    for (const Row& row : rows()) {
        SCOPED_TRACE(row.words);
        RowScene own(row);
        const Frame frame = DrawnModel(own.scene.model()).draw(own.view, own.quality);
        for (const Part& part : row.kept)
            EXPECT_FALSE(isDropped(frame.plan, part)) << words(part) << "\n" << told(frame.plan);
        for (const Part& part : row.dropped)
            EXPECT_TRUE(isDropped(frame.plan, part)) << words(part) << "\n" << told(frame.plan);
    }
}

// What a plan leaves out is paid for by nobody and missed by nobody: rays find no shadow either.
TEST(SceneTable, WhatIsDroppedCostsNothingAndIsNotMissed) {
    int dropped = 0;
    for (const Row& row : rows()) {
        SCOPED_TRACE(row.words);
        RowScene own(row);
        auto& [scene, quality, view] = own;
        DrawnModel model(scene.model());
        const Frame frame = model.draw(view, quality);
        if (!isDropped(frame.plan, Effect::ShadowMaps) || quality.shadows == plan::ShadowMode::Rays) continue;
        ++dropped;
        const render::Picture picture = model.backend().picture();
        EXPECT_TRUE(model.backend().shadowDepth().pixels.empty());
        const bool isOff = quality.shadows == plan::ShadowMode::Off;
        quality.shadows = plan::ShadowMode::Off;
        DrawnModel fresh(scene.model());
        const Frame off = fresh.draw(view, quality);
        expectNoCost(frame, off, fresh.backend());
        quality.shadows = plan::ShadowMode::Rays;
        if (isOff) continue;
        model.draw(view, quality);
        EXPECT_TRUE(model.backend().picture().pixels == picture.pixels) << "a shadow is missing";
    }
    EXPECT_GE(dropped, 5);
}

} // namespace
} // namespace gnomon::frame
