// Which kind of shadows a frame gets where that is left open: by counts, and steadily from frame to frame.
#include "plan/hysteresis.h"
#include "plan/shadow_choice.h"

#include <gtest/gtest.h>

#include <vector>

namespace gnomon::plan {
namespace {

/// The modes of frames whose costs are `costs`, one after the other.
std::vector<ShadowMode> modesOf(const std::vector<ShadowCosts>& costs) {
    std::vector<ShadowMode> modes;
    std::optional<ModeMemory> memory;
    for (const ShadowCosts& frame : costs) {
        const std::optional<ModeMemory> held = withoutCosts(memory);
        memory = held ? held : choiceByCosts(frame, memory).memory;
        modes.push_back(memory->isExact ? ShadowMode::Exact : ShadowMode::Maps);
    }
    return modes;
}

/// How often neighbours in `modes` differ.
int changesOf(const std::vector<ShadowMode>& modes) {
    int changes = 0;
    for (std::size_t i = 1; i < modes.size(); ++i)
        changes += modes[i] != modes[i - 1] ? 1 : 0;
    return changes;
}

constexpr ShadowCosts kExactIsCheap{1, 2};
constexpr ShadowCosts kMapsAreCheap{2, 1};
constexpr ShadowCosts kAlmostAlike{1, 0.95};

TEST(ShadowChoice, OfAFirstFrameIsTheCheaperAndExactWhereNeitherIs) {
    EXPECT_EQ(choiceByCosts({1, 1}, std::nullopt).mode, ShadowMode::Exact);
    EXPECT_EQ(choiceByCosts({1, 1}, std::nullopt).reason, ShadowReason::ExactCostsNoMore);
    EXPECT_EQ(choiceByCosts({1.01, 1}, std::nullopt).mode, ShadowMode::Maps);
    EXPECT_EQ(choiceByCosts({1.01, 1}, std::nullopt).reason, ShadowReason::MapsCostLess);
}

TEST(ShadowChoice, GrowsDearerWithEveryCount) {
    const ExactWork work{1e5, 1e5, 1e5, 1e6, 1e5, 1e6};
    const ShadowCosts costs = shadowCosts(work);

    struct Row {
        double ExactWork::*count;
        bool isOfExact;
        bool isOfMaps;
    };

    for (const Row& row :
         {Row{&ExactWork::samples, true, true},
          Row{&ExactWork::casterTriangles, true, true},
          Row{&ExactWork::castTriangles, true, false},
          Row{&ExactWork::sampleTests, true, false},
          Row{&ExactWork::keptTriangles, false, true},
          Row{&ExactWork::mapFragments, false, true}}) {
        ExactWork more = work;
        more.*row.count *= 2;
        EXPECT_EQ(shadowCosts(more).exact > costs.exact, row.isOfExact);
        EXPECT_EQ(shadowCosts(more).maps > costs.maps, row.isOfMaps);
        EXPECT_GE(shadowCosts(more).exact, costs.exact);
        EXPECT_GE(shadowCosts(more).maps, costs.maps);
    }
    EXPECT_LT(shadowCosts({}).exact, shadowCosts({}).maps) << "what faces away from the light has no shadow to draw";
}

// Views of bench/shadow_costs in which one kind took half as long again as the other, or more, with what was predicted
// of each: the choice has to see that.
TEST(ShadowChoice, TakesWhatWasMeasuredToBeCheaperByFar) {
    struct Row {
        const char* view = "";
        double exactOverMaps = 1;
        ExactWork predicted;
    };

    for (const Row& row : {
             Row{"clinic, within", 0.48, {6.97e4, 5.49e5, 1.08e5, 3.6e6, 3.38e5, 2.72e7}},
             Row{"bunny", 1.50, {2.27e5, 4.62e5, 1.96e5, 1.16e7, 4.13e5, 1.14e7}},
             Row{"dragon, close", 0.45, {4.38e4, 3.07e3, 176, 1.04e5, 2.3e3, 1.57e6}},
             Row{"plant, from above", 1.55, {3.49e4, 1.37e5, 9.24e4, 1.35e6, 2.1e5, 4.63e6}},
             Row{"statue", 1.47, {2.16e5, 2.06e5, 1.47e4, 1.41e6, 4.7e4, 4.52e6}},
         }) {
        const ShadowMode mode = choiceByCosts(shadowCosts(row.predicted), std::nullopt).mode;
        EXPECT_EQ(mode, row.exactOverMaps < 1 ? ShadowMode::Exact : ShadowMode::Maps) << row.view;
    }
}

TEST(ShadowChoice, HoldsUntilTheOtherIsCheaperByFarAndForLong) {
    for (const bool isExact : {true, false}) {
        const ShadowCosts first = isExact ? kExactIsCheap : kMapsAreCheap;
        const ShadowCosts other = isExact ? kMapsAreCheap : kExactIsCheap;
        std::vector<ShadowCosts> costs(200, other);
        costs[0] = first;
        const std::vector<ShadowMode> modes = modesOf(costs);
        EXPECT_EQ(changesOf(modes), 1);
        EXPECT_NE(modes.back(), modes.front());
        for (int i = 0; i < kFramesBeforeModeGoes; ++i)
            EXPECT_EQ(modes[static_cast<std::size_t>(i)], modes.front()) << i;
        for (std::size_t i = kFramesBeforeModeGoes + kFramesBetweenCosts; i < modes.size(); ++i)
            EXPECT_EQ(modes[i], modes.back()) << i;
    }
    std::vector<ShadowCosts> slightly(500, kAlmostAlike);
    slightly[0] = kExactIsCheap;
    EXPECT_EQ(changesOf(modesOf(slightly)), 0);
}

TEST(ShadowChoice, DoesNotFlickerWhereCostsDo) {
    for (const std::size_t period : {1U, 2U, 5U, 11U, 20U}) {
        std::vector<ShadowCosts> costs;
        for (std::size_t i = 0; i < 600; ++i)
            costs.push_back(i / period % 2 == 0 ? kExactIsCheap : kMapsAreCheap);
        EXPECT_EQ(changesOf(modesOf(costs)), 0) << period;
    }
}

TEST(ShadowChoice, LooksAtCostsOnceInAWhileAndAlwaysWhileDominated) {
    for (const bool isExact : {true, false}) {
        const ShadowCosts own = isExact ? kExactIsCheap : kMapsAreCheap;
        const ShadowCosts other = isExact ? kMapsAreCheap : kExactIsCheap;
        std::optional<ModeMemory> memory = choiceByCosts(own, std::nullopt).memory;
        int frames = 1;
        while (const auto held = withoutCosts(memory)) {
            EXPECT_EQ(held->isExact, isExact);
            memory = held;
            ++frames;
        }
        EXPECT_EQ(frames, kFramesBetweenCosts);
        EXPECT_FALSE(withoutCosts(choiceByCosts(other, memory).memory));
        EXPECT_TRUE(withoutCosts(choiceByCosts(own, choiceByCosts(other, memory).memory).memory));
    }
    EXPECT_FALSE(withoutCosts(std::nullopt));
}

} // namespace
} // namespace gnomon::plan
