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

TEST(MapReuse, IsNeverOfWarpedMaps) {
    const MadeScene scene(4);
    const FramePlan plan = planFrame(madeView(4), {}, scene.facts(madeView(4))).plan;
    ASSERT_FALSE(plan.passes.empty());
    EXPECT_FALSE(isSameMap(plan, plan, 0));
}

} // namespace
} // namespace gnomon::plan
