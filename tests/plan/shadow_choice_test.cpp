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
        const ShadowChoice choice = choiceWithoutCosts(memory).value_or(choiceByCosts(frame, memory));
        modes.push_back(choice.mode);
        memory = choice.memory;
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
    const ExactWork work{1e5, 1e5, 1e5, 1e6};
    const ShadowCosts costs = shadowCosts(work);
    for (double ExactWork::*count :
         {&ExactWork::samples, &ExactWork::casterTriangles, &ExactWork::castTriangles, &ExactWork::sampleTests}) {
        ExactWork more = work;
        more.*count *= 2;
        EXPECT_GT(shadowCosts(more).exact, costs.exact);
        EXPECT_GE(shadowCosts(more).maps, costs.maps);
    }
    EXPECT_LT(shadowCosts({}).exact, shadowCosts({}).maps) << "what faces away from the light has no shadow to draw";
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

TEST(ShadowChoice, LooksAtCostsOnceInAWhileAsLongAsItHasMaps) {
    std::optional<ModeMemory> memory = choiceByCosts(kMapsAreCheap, std::nullopt).memory;
    int frames = 1;
    while (const auto choice = choiceWithoutCosts(memory)) {
        EXPECT_EQ(choice->mode, ShadowMode::Maps);
        memory = choice->memory;
        ++frames;
    }
    EXPECT_EQ(frames, kFramesBetweenCosts);
    EXPECT_FALSE(choiceWithoutCosts(std::nullopt));
    EXPECT_FALSE(choiceWithoutCosts(choiceByCosts(kExactIsCheap, std::nullopt).memory));
}

} // namespace
} // namespace gnomon::plan
