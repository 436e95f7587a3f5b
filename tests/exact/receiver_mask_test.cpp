// The mask's pyramid against a look at every block.
#include "exact/receiver_mask.h"
#include "tests/exact/random.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::exact {
namespace {

constexpr int kBlock = 1 << ReceiverMask::kBlockBits;

/// The least value of the blocks that the box meets.
float plainLowest(const ReceiverMask& mask, const CellBox& box) {
    float min = ReceiverMask::kNone;
    for (int y = box.y0 / kBlock; y <= box.y1 / kBlock; ++y)
        for (int x = box.x0 / kBlock; x <= box.x1 / kBlock; ++x)
            min = std::min(min, mask.lowest(x, y));
    return min;
}

TEST(ReceiverMask, NeverLosesWhatABoxHolds) {
    RandomWholes random(1);
    int culled = 0;
    int small = 0;
    for (int i = 0; i < 300; ++i) {
        const int width = static_cast<int>(random.whole(1, 200));
        const int height = static_cast<int>(random.whole(1, 200));
        ReceiverMask mask;
        mask.reset(width, height);
        EXPECT_EQ(mask.blocksWide(), (width + kBlock - 1) / kBlock);
        EXPECT_EQ(mask.blocksHigh(), (height + kBlock - 1) / kBlock);
        for (std::int64_t set = random.whole(0, 30); set > 0; --set)
            mask.lowest(
                static_cast<int>(random.whole(0, mask.blocksWide() - 1)),
                static_cast<int>(random.whole(0, mask.blocksHigh() - 1))) = static_cast<float>(random.whole(-9, 9));
        mask.finish();
        for (int k = 0; k < 50; ++k) {
            CellBox box;
            box.x0 = static_cast<int>(random.whole(0, width - 1));
            box.y0 = static_cast<int>(random.whole(0, height - 1));
            box.x1 = static_cast<int>(random.whole(box.x0, width - 1));
            box.y1 = static_cast<int>(random.whole(box.y0, height - 1));
            const auto highest = static_cast<float>(random.whole(-10, 10));
            const bool may = mask.mayShadow(box, highest);
            const bool does = plainLowest(mask, box) < highest;
            EXPECT_TRUE(may || !does);
            culled += may ? 0 : 1;
            // Boxes of up to four blocks are looked up block by block.
            const bool isSmall = box.x1 / kBlock - box.x0 / kBlock < 4 && box.y1 / kBlock - box.y0 / kBlock < 4;
            EXPECT_TRUE(!isSmall || may == does);
            small += isSmall ? 1 : 0;
        }
    }
    EXPECT_GT(culled, 1000);
    EXPECT_GT(small, 1000);
}

TEST(ReceiverMask, OfNothingKeepsNothing) {
    ReceiverMask mask;
    mask.reset(100, 7);
    mask.finish();
    EXPECT_FALSE(mask.mayShadow({0, 0, 99, 6}, std::numeric_limits<float>::max()));
    EXPECT_FALSE(mask.mayShadow({0, 0, 99, 6}, ReceiverMask::kNone));
    mask.lowest(12, 0) = -5;
    mask.finish();
    EXPECT_TRUE(mask.mayShadow({96, 6, 99, 6}, -4.9F));
    EXPECT_FALSE(mask.mayShadow({96, 6, 99, 6}, -5));
    mask.reset(100, 7);
    mask.finish();
    EXPECT_FALSE(mask.mayShadow({0, 0, 99, 6}, 9));
}

} // namespace
} // namespace gnomon::exact
