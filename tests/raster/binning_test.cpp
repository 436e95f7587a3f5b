#include "core/random.h"
#include "raster/binning.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::raster {
namespace {

std::vector<BinItem> randomItems(std::uint64_t seed, int count) {
    Random random(seed);
    std::vector<BinItem> items;
    for (int i = 0; i < count; ++i) {
        const int size = random.below(10) == 0 ? 900 : 20;
        const int x = static_cast<int>(random.below(1400)) - 200;
        const int y = static_cast<int>(random.below(400)) - 100;
        items.push_back(
            {{x, y, x + static_cast<int>(random.below(static_cast<std::uint64_t>(size))), y + size / 2},
             static_cast<std::uint32_t>(random.below(128))});
    }
    // Many in one corner, so that tiles are split.
    for (int i = 0; i < count; ++i)
        items.push_back({{300 + i % 30, 80, 303 + i % 30, 83 + i % 50}, 128});
    return items;
}

/// Pixels outside of the viewport that a tile owns, and pixels inside that not exactly one owns.
int wronglyOwned(const Bins& bins, const PixelBox& viewport) {
    constexpr int kWidth = 2000;
    constexpr int kHeight = 300;
    std::vector<int> owners(std::size_t{kWidth} * kHeight);
    const auto add = [&owners](const PixelBox& box, int count) {
        for (int y = box.y0; y < box.y1; ++y)
            for (int x = box.x0; x < box.x1; ++x)
                owners[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)] += count;
    };
    for (const TileBin& tile : bins.tiles)
        add(tile.box, 1);
    add(viewport, -1);
    return static_cast<int>(std::count_if(owners.begin(), owners.end(), [](int count) { return count != 0; }));
}

TEST(Binning, TilesAreTheViewportAndHoldWhatTouchesThem) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const PixelBox viewport = {13, 9, 13 + static_cast<int>(50 * seed + 1), 250};
        const std::vector<BinItem> items = randomItems(seed, 300);
        Bins bins;
        binItems(items, viewport, 128, 32, bins);
        EXPECT_EQ(wronglyOwned(bins, viewport), 0);
        for (const TileBin& tile : bins.tiles) {
            std::vector<std::uint32_t> expected;
            for (std::uint32_t i = 0; i < items.size(); ++i)
                if (!intersection(items[i].box, tile.box).empty()) expected.push_back(i);
            const auto held = std::span(bins.indices).subspan(tile.first, tile.count);
            ASSERT_TRUE(std::equal(held.begin(), held.end(), expected.begin(), expected.end()));
        }
    }
}

TEST(Binning, ACrowdedTileIsSplitAndTheDearestComesFirst) {
    const std::vector<BinItem> items = randomItems(1, 500);
    Bins bins;
    binItems(items, {0, 0, 512, 256}, 256, 32, bins);
    EXPECT_GT(bins.tiles.size(), 8U);
    EXPECT_TRUE(std::is_sorted(
        bins.tiles.begin(), bins.tiles.end(), [](const TileBin& a, const TileBin& b) { return a.cost > b.cost; }));
}

/// One item that costs as much as all others together, in a field of many cheap ones.
std::vector<BinItem> field(std::uint32_t expensive) {
    std::vector<BinItem> items;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            items.push_back({{64 * x, 64 * y, 64 * x + 64, 64 * y + 64}, 10});
    items.push_back({{5, 5, 6, 6}, expensive});
    return items;
}

TEST(Binning, ATileIsSplitOnlyWhereItHoldsMoreThanItsShare) {
    Bins bins;
    binItems(field(10), {0, 0, 512, 512}, 64, 8, bins); // 20 of 650: less than a thirty-second
    EXPECT_EQ(bins.tiles.size(), 64U);
    binItems(field(11), {0, 0, 512, 512}, 64, 8, bins); // 21 of 651: more
    EXPECT_GT(bins.tiles.size(), 64U);
    for (const TileBin& tile : bins.tiles) {
        EXPECT_TRUE(tile.box.width() >= 64 || tile.box.x1 <= 64) << "what is cheap stays whole";
        EXPECT_GE(tile.box.width(), 8);
    }
}

TEST(Binning, SplittingEndsAtTheLeastSide) {
    Bins bins;
    binItems(field(100000), {0, 0, 512, 512}, 64, 16, bins);
    int min = 512;
    for (const TileBin& tile : bins.tiles)
        min = std::min({min, tile.box.width(), tile.box.height()});
    EXPECT_EQ(min, 16);
    EXPECT_EQ(bins.tiles.front().box, (PixelBox{0, 0, 16, 16})) << "the dearest first";
    EXPECT_EQ(bins.tiles.front().cost, 100010U);
    binItems(field(100000), {0, 0, 512, 512}, 64, 64, bins);
    EXPECT_EQ(bins.tiles.size(), 64U);
}

TEST(Binning, ATilesCostIsThatOfWhatItHolds) {
    const std::vector<BinItem> items = randomItems(4, 400);
    Bins bins;
    binItems(items, {0, 0, 1000, 256}, 128, 32, bins);
    for (const TileBin& tile : bins.tiles) {
        std::uint64_t cost = 0;
        for (std::uint32_t k = 0; k < tile.count; ++k)
            cost += items[bins.indices[tile.first + k]].cost;
        EXPECT_EQ(tile.cost, cost);
    }
    Bins again;
    binItems(items, {0, 0, 1000, 256}, 128, 32, again);
    binItems(items, {0, 0, 1000, 256}, 128, 32, bins); // in the memory of the first
    ASSERT_EQ(bins.tiles.size(), again.tiles.size());
    for (std::size_t t = 0; t < bins.tiles.size(); ++t)
        EXPECT_EQ(bins.tiles[t].box, again.tiles[t].box);
    EXPECT_EQ(intersection({0, 1, 5, 6}, {2, 0, 9, 4}), (PixelBox{2, 1, 5, 4}));
    EXPECT_TRUE(intersection({0, 0, 2, 2}, {2, 0, 4, 2}).empty()) << "half-open";
}

TEST(Binning, AnEmptyViewportHasNoTiles) {
    Bins bins;
    binItems(randomItems(1, 10), {5, 5, 5, 90}, 256, 32, bins);
    EXPECT_TRUE(bins.tiles.empty());
}

std::int64_t pixelsOf(const PixelBox& box) {
    return box.empty() ? 0 : std::int64_t{box.width()} * box.height();
}

TEST(Binning, DropsTilesThatNobodyWants) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const PixelBox viewport = {13, 9, 13 + static_cast<int>(50 * seed + 1), 250};
        const std::vector<BinItem> items = randomItems(seed, 300);
        Random random(seed);
        std::vector<PixelBox> wanted;
        for (int i = 0; i < 5; ++i) {
            const int x = 13 + static_cast<int>(random.below(static_cast<std::uint64_t>(viewport.width())));
            const int y = 9 + static_cast<int>(random.below(240));
            wanted.push_back(intersection({x, y, x + 1 + static_cast<int>(random.below(90)), y + 30}, viewport));
        }
        const auto isWanted = [&](const PixelBox& box) {
            return std::any_of(
                wanted.begin(), wanted.end(), [&](const PixelBox& part) { return !intersection(part, box).empty(); });
        };
        Bins bins;
        binWanted(items, viewport, isWanted, 256, 32, bins);
        std::int64_t held = 0;
        for (const TileBin& tile : bins.tiles) {
            EXPECT_TRUE(isWanted(tile.box));
            std::vector<std::uint32_t> expected;
            for (std::uint32_t i = 0; i < items.size(); ++i)
                if (!intersection(items[i].box, tile.box).empty()) expected.push_back(i);
            const auto found = std::span(bins.indices).subspan(tile.first, tile.count);
            ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
            for (const PixelBox& part : wanted)
                held += pixelsOf(intersection(part, tile.box));
        }
        std::int64_t all = 0;
        for (const PixelBox& part : wanted)
            all += pixelsOf(part);
        EXPECT_EQ(held, all) << "each wanted pixel lies in one tile";
    }
}

} // namespace
} // namespace gnomon::raster
