// Which maps of the frame before may stay: only those that nothing could have changed.
#include "made_scene.h"
#include "plan/map_reuse.h"

#include <gtest/gtest.h>

#include <functional>

namespace gnomon::plan {
namespace {

FramePlan stablePlan() {
    const MadeScene scene(4);
    Quality quality;
    quality.stabilize = true;
    return planFrame(madeView(4), quality, scene.facts(madeView(4))).plan;
}

TEST(MapReuse, IsOfEqualMapsAlone) {
    const FramePlan plan = stablePlan();
    ASSERT_GT(plan.passes.size(), 1U);
    for (std::size_t i = 0; i < plan.passes.size(); ++i)
        EXPECT_TRUE(isSameMap(plan, plan, i));

    struct Row {
        const char* what;
        std::function<void(FramePlan&)> change;
        bool concernsAll; // and not the second map alone
    };

    const std::vector<Row> table{
        {"texture width", [](FramePlan& p) { ++p.textureWidth; }, true},
        {"texture height", [](FramePlan& p) { ++p.textureHeight; }, true},
        {"number of maps", [](FramePlan& p) { p.passes.push_back(p.passes.front()); }, true},
        {"a rectangle", [](FramePlan& p) { ++p.passes[1].map.rectangle.x; }, true},
        {"light", [](FramePlan& p) { ++p.light.direction.x; }, true},
        {"place", [](FramePlan& p) { ++p.passes[1].map.stable->corner[2]; }, false},
        {"texel", [](FramePlan& p) { p.passes[1].map.stable->texel *= 1.5; }, false},
        {"not stabilised", [](FramePlan& p) { p.passes[1].map.stable.reset(); }, false},
        {"gutter", [](FramePlan& p) { ++p.passes[1].map.gutter; }, false},
        {"shift", [](FramePlan& p) { p.passes[1].map.shift.x += 0.25; }, false},
        {"depth clamp", [](FramePlan& p) { p.passes[1].clampsDepth = !p.passes[1].clampsDepth; }, false},
    };
    for (const Row& row : table) {
        SCOPED_TRACE(row.what);
        FramePlan other = plan;
        row.change(other);
        EXPECT_FALSE(isSameMap(plan, other, 1));
        EXPECT_EQ(isSameMap(plan, other, 0), !row.concernsAll);
    }
}

TEST(MapReuse, IsOfWarpedMapsFromTheSameCamera) {
    const MadeScene scene(4);
    const FramePlan plan = planFrame(madeView(4), {}, scene.facts(madeView(4))).plan;
    ASSERT_GT(plan.passes.size(), 1U);
    EXPECT_TRUE(isSameMap(plan, plan, 0));
    EXPECT_TRUE(isSameImage(plan, plan));

    struct Row {
        const char* what;
        std::function<void(FramePlan&)> change;
        bool isSameMap;
    };

    const std::vector<Row> table{
        {"eye", [](FramePlan& p) { p.view.camera.eye.x += 1e-9; }, false},
        {"direction", [](FramePlan& p) { p.basis.view.y += 1e-9; }, false},
        {"warp", [](FramePlan& p) { p.passes[0].map.warped.kappa += 1e-6; }, false},
        {"extent", [](FramePlan& p) { p.passes[0].map.warped.width *= 1.001; }, false},
        {"depth", [](FramePlan& p) { p.passes[0].map.warped.rawMin += 1e-3; }, false},
        {"origin", [](FramePlan& p) { p.passes[0].map.origin.z += 1; }, false},
        {"shift", [](FramePlan& p) { p.passes[0].map.shift.y -= 0.5; }, false},
        {"stabilised", [](FramePlan& p) { p.passes[0].map.stable.emplace(); }, false},
        {"light", [](FramePlan& p) { ++p.light.direction.z; }, false},
        {"image", [](FramePlan& p) { ++p.view.height; }, true},
        {"angle", [](FramePlan& p) { p.view.camera.fovYRadians += 1e-6; }, true},
        {"filter", [](FramePlan& p) { p.quality.filter = 3; }, true},
        {"splits", [](FramePlan& p) { p.selector.splits[1] *= 1.001; }, true},
        {"ground", [](FramePlan& p) { p.quality.look.ground = true; }, true},
        {"sun's width", [](FramePlan& p) { p.view.sunAngleRadians = 0.01; }, true},
        {"error", [](FramePlan& p) { p.quality.errorPixels *= 1.001; }, true},
        {"culling", [](FramePlan& p) { p.quality.cullCasters = CasterCulling::Receivers; }, true},
        {"kernel", [](FramePlan& p) { p.passes[0].map.filterTexels += 1; }, true},
        {"backend", [](FramePlan& p) { p.backend = kSoftwareCapabilities; }, true},
        {"partitions", [](FramePlan& p) { p.passOfPartition[0] = -1; }, true},
    };
    for (const Row& row : table) {
        SCOPED_TRACE(row.what);
        FramePlan other = plan;
        row.change(other);
        EXPECT_EQ(isSameMap(plan, other, 0), row.isSameMap);
        EXPECT_FALSE(isSameImage(plan, other));
    }
}

} // namespace
} // namespace gnomon::plan
