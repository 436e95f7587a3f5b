// The depth range: where each end comes from, exactly where it lies, and what is refused.
#include "core/error.h"
#include "made_scene.h"
#include "plan/depth_range.h"
#include "plan/hysteresis.h"

#include <gtest/gtest.h>

namespace gnomon::plan {
namespace {

struct DepthRow {
    const char* what;
    std::optional<double> near;
    std::optional<double> far;
    std::optional<double> nearFloor;
    SceneFacts::Visible visible;
    double expectedNear;
    double expectedFar;
    DepthSource nearFrom;
    DepthSource farFrom;
};

TEST(DepthRange, LiesWhereItsTableSays) {
    using Source = DepthSource;
    const std::vector<DepthRow> table{
        {"a step of 2^(1/4)", {}, {}, {}, {8, 100, true}, 8, 100, Source::NearestSurface, Source::FarthestSurface},
        {"between steps", {}, {}, {}, {9, 100, true}, 8, 100, Source::NearestSurface, Source::FarthestSurface},
        {"just under a step",
         {},
         {},
         {},
         {7.99, 100, true},
         6.727171322,
         100,
         Source::NearestSurface,
         Source::FarthestSurface},
        {"under the floor", {}, {}, {}, {1e-9, 100, true}, 0.01, 100, Source::Floor, Source::FarthestSurface},
        {"a given floor", {}, {}, 3, {1, 100, true}, 3, 100, Source::Floor, Source::FarthestSurface},
        {"a floor that does not matter",
         {},
         {},
         1,
         {8, 100, true},
         8,
         100,
         Source::NearestSurface,
         Source::FarthestSurface},
        {"near given", 5, {}, {}, {8, 100, true}, 5, 100, Source::Given, Source::FarthestSurface},
        {"far given", {}, 50, {}, {8, 100, true}, 8, 50, Source::NearestSurface, Source::Given},
        {"the floor of a given far", {}, 50, {}, {1e-9, 100, true}, 0.005, 50, Source::Floor, Source::Given},
        {"both given", 5, 50, {}, {8, 100, true}, 5, 50, Source::Given, Source::Given},
        {"both given, nothing in view", 5, 50, {}, {}, 5, 50, Source::Given, Source::Given},
        {"nothing in view", {}, {}, {}, {}, 1, 2, Source::NothingInView, Source::NothingInView},
        {"near given, nothing in view", 5, {}, {}, {}, 1, 2, Source::NothingInView, Source::NothingInView},
        {"all at one depth", {}, {}, {}, {8, 8, true}, 8, 8.008, Source::NearestSurface, Source::FarthestSurface},
        {"a far before all there is", {}, 4, {}, {8, 9, true}, 4 / 1.001, 4, Source::NearestSurface, Source::Given},
    };
    for (const DepthRow& row : table) {
        SCOPED_TRACE(row.what);
        Quality quality;
        quality.near = row.near;
        quality.far = row.far;
        quality.nearFloor = row.nearFloor;
        SceneFacts facts;
        facts.visible = row.visible;
        const DepthRange range = depthRange({}, quality, facts, {});
        EXPECT_NEAR(range.depths.near / row.expectedNear, 1, 2e-6);
        EXPECT_NEAR(range.depths.far / row.expectedFar, 1, 2e-6);
        EXPECT_GE(range.depths.far, std::min(row.visible.farthest, row.expectedFar));
        EXPECT_EQ(range.nearFrom, row.nearFrom);
        EXPECT_EQ(range.farFrom, row.farFrom);
        EXPECT_EQ(range.isEmpty, !row.visible.anything);
        EXPECT_EQ(range.memory.has_value(), row.visible.anything);
    }
}

TEST(DepthRange, ShowsWhatLiesBeyondGivenEndsInQuantizedSteps) {
    const auto shown = [](const Quality& quality, double nearest, double farthest) {
        SceneFacts facts;
        facts.visible = {nearest, farthest, true};
        return depthRange(View(), quality, facts, {}).shown;
    };
    Quality quality;
    EXPECT_EQ(shown(quality, 8, 100).near, 8) << "automatic ends leave nothing out";
    EXPECT_NEAR(shown(quality, 8, 100).far, 100, 1e-3);
    EXPECT_EQ(shown(quality, 1e-9, 100).near, 100 * (1 + 1e-6) / 1e4) << "but what is under the floor";
    quality.near = 20;
    quality.far = 50;
    EXPECT_EQ(shown(quality, 25, 40), (DepthSpan{20, 50}));
    EXPECT_EQ(shown(quality, 8, 40), (DepthSpan{8, 50}));
    EXPECT_EQ(shown(quality, 25, 128), (DepthSpan{20, 128}));
    EXPECT_NEAR(shown(quality, 9, 100).near, 8, 1e-9);
    EXPECT_NEAR(shown(quality, 9, 100).far, std::exp2(6.75), 1e-9);
    EXPECT_NEAR(shown(quality, 0, 64).near, 64 / 1e4, 1e-9) << "no map begins at the eye";
}

TEST(DepthRange, IsWidestForMapsAloneAndWhereAnythingLiesAhead) {
    const View view = madeView(1);
    const Box around{view.camera.eye - 10.0, view.camera.eye + 20.0};
    Quality quality;
    const std::optional<DepthSpan> widest = widestRange(view, quality, around);
    ASSERT_TRUE(widest);
    const FramePlan plan = planFrame(view, quality, {.bounds = around, .visible = {}, .light = {}}).plan;
    EXPECT_LE(widest->near, plan.near);
    EXPECT_GE(widest->far, plan.far);
    EXPECT_FALSE(widestRange(view, quality, {}));
    for (const ShadowMode mode : {ShadowMode::Off, ShadowMode::Rays}) {
        quality.shadows = mode;
        EXPECT_FALSE(widestRange(view, quality, around));
    }
}

TEST(DepthRange, HoldsWhatItShowsBeyondAGivenEndForSomeFrames) {
    Quality quality;
    quality.far = 50;
    std::optional<DepthMemory> memory;
    const auto farShown = [&](double farthest) {
        SceneFacts facts;
        facts.visible = {8, farthest, true};
        DepthRange range = depthRange(View(), quality, facts, memory);
        memory = range.memory;
        return range.shown.far;
    };
    EXPECT_EQ(farShown(128), 128);
    EXPECT_EQ(farShown(512), 512) << "it grows at once";
    for (int i = 1; i < kFramesBeforeNearRises; ++i)
        EXPECT_EQ(farShown(40), 512) << i;
    EXPECT_EQ(farShown(40), 50);
    EXPECT_FALSE(memory->inverseShownFar);
}

TEST(DepthRange, IsThatOfTheBoundsBeforeTheHierarchyWasAsked) {
    SceneFacts facts;
    facts.bounds = {{-1, -2, -30}, {1, 2, -10}};
    View view;
    view.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1};
    const DepthRange range = depthRange(view, {}, facts, {});
    EXPECT_EQ(range.nearFrom, DepthSource::ModelBounds);
    EXPECT_EQ(range.farFrom, DepthSource::ModelBounds);
    EXPECT_LE(range.depths.near, 10);
    EXPECT_GT(range.depths.near, 10 / std::exp2(0.25));
    EXPECT_NEAR(range.depths.far, 30, 1e-4);
    view.camera.target = {0, 0, 1};
    EXPECT_TRUE(depthRange(view, {}, facts, {}).isEmpty) << "all lies behind the eye";
}

TEST(DepthRange, RefusesEndsThatAreNoRangeInWordsOfItsOwn) {
    const double infinity = std::numeric_limits<double>::infinity();
    SceneFacts facts;
    facts.visible = {8, 100, true};
    for (const auto& [near, far] : {std::pair(5.0, 5.0), {5.0, 4.0}, {0.0, 4.0}, {-1.0, 4.0}, {1.0, infinity}}) {
        Quality quality;
        quality.near = near;
        quality.far = far;
        try {
            depthRange({}, quality, facts, {});
            ADD_FAILURE() << near << " to " << far;
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find("--"), std::string::npos) << error.what();
        }
    }
}

} // namespace
} // namespace gnomon::plan
