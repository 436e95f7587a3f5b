// Sums over boxes of cells against counting them one by one.
#include "core/random.h"
#include "frame/point_sums.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::frame {
namespace {

constexpr auto kCells = static_cast<std::size_t>(plan::kCellSide);

exact::CellBox randomBox(Random& random) {
    const auto cell = [&] { return static_cast<int>(random.below(kCells)); };
    const std::array<int, 4> at{cell(), cell(), cell(), cell()};
    return {std::min(at[0], at[1]), std::min(at[2], at[3]), std::max(at[0], at[1]), std::max(at[2], at[3])};
}

template <class Value>
double plainly(const exact::CellBox& box, const Value& valueOf) {
    double sum = 0;
    for (int y = box.y0; y <= box.y1; ++y)
        for (int x = box.x0; x <= box.x1; ++x)
            sum += valueOf(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
    return sum;
}

std::size_t blockOf(std::size_t x, std::size_t y) {
    return (y >> kBlockBits) * kBlocks + (x >> kBlockBits);
}

TEST(PointSums, AreThePointsOfEachCellTimesTheShareOfItsBlock) {
    Random random(1);
    std::vector<std::uint32_t> first{0};
    for (std::size_t i = 0; i < kCells * kCells; ++i)
        first.push_back(first.back() + static_cast<std::uint32_t>(random.below(20) == 0 ? random.below(5) : 0));
    std::vector<double> shares;
    for (std::size_t i = 0; i < kBlocks * kBlocks; ++i)
        shares.push_back(random.uniform(0, 1));
    for (const std::vector<double>& of : {std::vector<double>(), shares}) {
        PointSums sums;
        sums.add(first, of);
        for (int i = 0; i < 200; ++i) {
            const exact::CellBox box = randomBox(random);
            const double plain = plainly(box, [&](std::size_t x, std::size_t y) {
                const double points = first[y * kCells + x + 1] - first[y * kCells + x];
                return of.empty() ? points : points * of[blockOf(x, y)];
            });
            ASSERT_NEAR(sums.in(box), plain, 1e-5 * first.back()) << "floats";
        }
    }
    EXPECT_EQ(PointSums().in({3, 3, 2, 9}), 0);
}

TEST(AskedCells, AreTheCellsOfBlocksWithPoints) {
    Random random(2);
    exact::ReceiverMask mask;
    mask.reset(plan::kCellSide, plan::kCellSide);
    std::vector<bool> isAsked;
    for (std::size_t i = 0; i < kBlocks * kBlocks; ++i) {
        isAsked.push_back(random.below(3) == 0);
        if (isAsked.back()) mask.lowest(static_cast<int>(i % kBlocks), static_cast<int>(i / kBlocks)) = 7;
    }
    mask.finish();
    AskedCells asked;
    asked.add(mask);
    for (int i = 0; i < 500; ++i) {
        const exact::CellBox box = randomBox(random);
        ASSERT_EQ(asked.in(box), plainly(box, [&](std::size_t x, std::size_t y) { return isAsked[blockOf(x, y)]; }));
    }
    EXPECT_EQ(asked.in({3, 3, 2, 9}), 0);
}

} // namespace
} // namespace gnomon::frame
