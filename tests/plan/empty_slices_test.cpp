// Which slices go without a map: the rule alone, bit by bit.
#include "plan/empty_slices.h"
#include "plan/hysteresis.h"

#include <gtest/gtest.h>

namespace gnomon::plan {
namespace {

const std::vector<double> kSplits{1, 2, 4, 8, 16};

TEST(EmptySlices, AreThoseThatNothingLitTouches) {
    struct Row {
        std::vector<DepthSpan> lit;
        std::uint64_t without;
    };

    const std::vector<Row> table{
        {{}, 0b1111},
        {{{1, 16}}, 0b0000},
        {{{1.5, 1.6}}, 0b1110},
        {{{2.5, 3}}, 0b1101},
        {{{9, 10}}, 0b0111},
        {{{3, 5}}, 0b1001},
        {{{1.1, 1.2}, {9, 10}}, 0b0110},
        {{{0.1, 0.2}}, 0b1110}, // before the first slice, which owns it
        {{{50, 60}}, 0b0111},   // and behind the last
        {{{4, 4}}, 0b1001},     // on a split: either side may round to it
    };
    for (const Row& row : table)
        EXPECT_EQ(slicesWithout(row.lit, kSplits), row.without) << testing::PrintToString(row.lit.size());
}

SchemeMemory memoryWithout(std::uint64_t slices) {
    SchemeMemory memory;
    memory.choice.slices = 4;
    memory.emptySlices = slices;
    return memory;
}

TEST(EmptySlices, AReceiverInASliceWithoutAMapHasArrived) {
    const std::vector<DepthSpan> lit{{2.5, 3}};
    EXPECT_TRUE(receiversNow(lit, memoryWithout(0b0010), kSplits).haveArrived);
    EXPECT_FALSE(receiversNow(lit, memoryWithout(0b1101), kSplits).haveArrived);
    EXPECT_FALSE(receiversNow(lit, std::nullopt, kSplits).haveArrived);
    const Receivers arrived = receiversNow(lit, memoryWithout(0b0110), kSplits);
    EXPECT_EQ(slicesWithoutMap(arrived, kSplits, memoryWithout(0b0110), true), 0U) << "all maps come at once";
}

TEST(EmptySlices, AreJudgedByAWholeStretchOfFrames) {
    SchemeMemory memory = memoryWithout(0);
    memory.lit.frames = kFramesBeforeMapsGo - 2;
    memory.lit.since = {{1.5, 1.6}};
    const std::vector<DepthSpan> lit{{2.5, 3}};
    Receivers receivers = receiversNow(lit, memory, kSplits);
    EXPECT_FALSE(receivers.isStretchOver);
    EXPECT_EQ(receivers.memory.frames, kFramesBeforeMapsGo - 1);
    EXPECT_EQ(slicesWithoutMap(receivers, kSplits, memory, true), 0U);
    memory.lit = receivers.memory;
    receivers = receiversNow(lit, memory, kSplits);
    EXPECT_TRUE(receivers.isStretchOver);
    EXPECT_EQ(receivers.memory.frames, 0);
    EXPECT_EQ(slicesWithoutMap(receivers, kSplits, memory, true), 0b1100U) << "what was lit on the way counts";
    EXPECT_EQ(receivers.memory.since, lit);
    ASSERT_TRUE(receivers.memory.before);
    EXPECT_EQ(receivers.memory.before->size(), 2U);
}

TEST(EmptySlices, StayWithoutAMapAndAnotherSchemesGoByAllThatIsRemembered) {
    SchemeMemory memory = memoryWithout(0b1000);
    const std::vector<DepthSpan> lit{{1.5, 5}};
    const Receivers receivers = receiversNow(lit, memory, kSplits);
    EXPECT_EQ(slicesWithoutMap(receivers, kSplits, memory, true), 0b1000U);
    EXPECT_EQ(slicesWithoutMap(receivers, kSplits, memory, false), 0U) << "nothing is remembered yet";
    memory.lit.before = std::vector<DepthSpan>{{1.5, 1.6}};
    memory.lit.since = {{2.5, 3}};
    const std::vector<DepthSpan> none;
    const Receivers later = receiversNow(none, memory, kSplits);
    EXPECT_EQ(slicesWithoutMap(later, kSplits, memory, false), 0b1100U);
}

} // namespace
} // namespace gnomon::plan
