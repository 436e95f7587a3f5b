#include "plan/caster_culling.h"

#include <gtest/gtest.h>

namespace gnomon::plan {
namespace {

FramePlan planOf(CasterCulling asked, std::uint64_t triangles) {
    FramePlan plan;
    plan.view.width = plan.view.height = 100;
    plan.quality.cullCasters = asked;
    plan.passes.resize(2);
    plan.passes[0].estimatedTriangles = triangles / 2;
    plan.passes[1].estimatedTriangles = triangles - triangles / 2;
    return plan;
}

TEST(CasterCulling, IsChosenByCountsAndByWhoDraws) {
    struct Row {
        const char* words;
        CasterCulling asked;
        std::uint64_t triangles;
        bool isImageFirst;
        bool isStable;
        CasterCulling chosen;
        std::optional<SkipReason> reason;
    };

    using C = CasterCulling;
    using R = SkipReason;
    const std::uint64_t few = std::uint64_t{100} * 100 / kPixelsPerTriangle - 1;
    const std::vector<Row> rows = {
        {"many casters", C::Auto, few + 1, true, false, C::Receivers, {}},
        {"few casters", C::Auto, few, true, false, C::On, R::FewCasters},
        {"few, but asked for", C::Receivers, few, true, false, C::Receivers, {}},
        {"kept for other views", C::Auto, 1'000'000, true, true, C::On, R::MapsAreKept},
        {"kept, but asked for", C::Receivers, 1, true, true, C::Receivers, {}},
        {"maps first", C::Auto, 1'000'000, false, false, C::On, R::MapsComeFirst},
        {"maps first, asked for", C::Receivers, 1'000'000, false, false, C::On, R::MapsComeFirst},
        {"on", C::On, 1'000'000, true, false, C::On, R::SwitchedOff},
        {"off", C::Off, 1'000'000, true, false, C::Off, R::SwitchedOff},
    };
    for (const Row& row : rows) {
        SCOPED_TRACE(row.words);
        FramePlan plan = planOf(row.asked, row.triangles);
        plan.quality.stabilize = row.isStable;
        plan.backend.imageFirst = row.isImageFirst;
        chooseCasterCulling(plan);
        EXPECT_EQ(plan.casterCulling, row.chosen);
        ASSERT_EQ(plan.omitted.size(), row.reason ? 1U : 0U);
        if (!row.reason) continue;
        EXPECT_EQ(plan.omitted[0], (SkippedEffect{Effect::ReceiverMasks, *row.reason}));
    }
    FramePlan without = planOf(C::Auto, 5);
    without.passes.clear();
    chooseCasterCulling(without);
    EXPECT_TRUE(without.omitted.empty()) << "there is nothing to cull";
}

} // namespace
} // namespace gnomon::plan
