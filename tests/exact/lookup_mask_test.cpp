// The mask of lookups beside a list of them, and the bounds of casters beside what the rasteriser draws of them.
#include "core/random.h"
#include "exact/lookup_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::exact {
namespace {

constexpr int kWidth = 300;
constexpr int kHeight = 170;

struct Lookup {
    LookupTexels texels;
    float depth = 0;
};

std::vector<Lookup> randomLookups(Random& random, std::size_t count) {
    const auto texel = [&](int side) {
        return static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(side)));
    };
    std::vector<Lookup> lookups;
    for (std::size_t i = 0; i < count; ++i) {
        Lookup lookup;
        lookup.texels.firstColumn = texel(kWidth - 4);
        lookup.texels.firstRow = texel(kHeight - 4);
        lookup.texels.lastColumn = lookup.texels.firstColumn + texel(4);
        lookup.texels.lastRow = lookup.texels.firstRow + texel(4);
        lookup.depth = static_cast<float>(random.uniform(-0.2, 1));
        if (random.below(20) == 0) lookup.depth = std::nanf("");
        lookups.push_back(lookup);
    }
    return lookups;
}

LookupMask maskOf(std::span<const Lookup> lookups) {
    LookupMask mask;
    mask.reset(kWidth, kHeight);
    {
        LookupMask::Run run(mask);
        for (const Lookup& lookup : lookups)
            run.add(lookup.texels, lookup.depth);
    }
    mask.finish();
    return mask;
}

raster::PixelBox randomBox(Random& random) {
    const int x = static_cast<int>(random.below(kWidth));
    const int y = static_cast<int>(random.below(kHeight));
    const int side = 1 << random.below(8);
    return {x, y, std::min(kWidth, x + side), std::min(kHeight, y + 1 + static_cast<int>(random.below(64)))};
}

/// Whether a lookup reads a texel of `box` and is darkened by `nearest`, one after another.
bool plainMayShadow(std::span<const Lookup> lookups, const raster::PixelBox& box, float nearest, int margin) {
    return std::any_of(lookups.begin(), lookups.end(), [&](const Lookup& lookup) {
        const LookupTexels& t = lookup.texels;
        const bool meets = t.firstColumn < box.x1 + margin && t.lastColumn >= box.x0 - margin &&
                           t.firstRow < box.y1 + margin && t.lastRow >= box.y0 - margin;
        return meets && lookup.depth > std::max(nearest, 0.0F);
    });
}

TEST(LookupMask, NamesEveryCasterThatALookupMeets) {
    Random random(3);
    std::size_t hit = 0;
    std::size_t ruledOut = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const std::vector<Lookup> lookups = randomLookups(random, 1 + random.below(60));
        const LookupMask mask = maskOf(lookups);
        for (int i = 0; i < 100; ++i) {
            const CasterBound bound = {randomBox(random), static_cast<float>(random.unit())};
            const bool may = mask.mayShadow(bound);
            const bool isHit = plainMayShadow(lookups, bound.texels, bound.nearest, 0);
            hit += isHit ? 1U : 0U;
            ruledOut += may ? 0U : 1U;
            EXPECT_TRUE(may || !isHit);
            // No more than the blocks of the level of the pyramid that the box is looked up at lie around it.
            const int side = std::max(bound.texels.width(), bound.texels.height());
            EXPECT_TRUE(!may || plainMayShadow(lookups, bound.texels, bound.nearest, side + 16));
            EXPECT_FALSE(isHit && mask.isEmpty(bound.texels));
        }
    }
    EXPECT_GT(hit, 300U);
    EXPECT_GT(ruledOut, 300U);
}

/// A perspective or plain view of cells about the origin, tilted.
raster::View randomView(Random& random) {
    raster::View view;
    view.eyeCell = {1000, 2000, 3000};
    const double slope = random.below(3) == 0 ? 0 : std::exp2(random.uniform(-14, -8)); // of w along z
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            view.clipFromCell[column][row] = static_cast<float>(random.uniform(-1, 1) / 900);
    view.clipFromCell[0][3] = static_cast<float>(slope * random.uniform(-1, 1));
    view.clipFromCell[1][3] = static_cast<float>(slope * random.uniform(-1, 1));
    view.clipFromCell[2][3] = static_cast<float>(slope);
    view.clipFromCell[3] = {0.05F, -0.1F, 0.5F, 1};
    view.viewport = {11, 5, kWidth - 7, kHeight};
    return view;
}

struct BoxOfTriangles {
    raster::CellBox box;
    std::vector<std::uint32_t> positions;
    std::vector<raster::Triangle> triangles;
};

/// Random triangles with their corners in a box, some in its corners.
BoxOfTriangles randomTriangles(Random& random) {
    BoxOfTriangles result;
    std::array<std::uint32_t, 3> low{};
    std::array<std::uint32_t, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = static_cast<std::uint32_t>(1000 * (axis + 1) - 700 + random.below(1400));
        size[axis] = static_cast<std::uint32_t>(random.below(2) == 0 ? random.below(4) : random.below(400));
    }
    result.box.min = low;
    for (std::size_t axis = 0; axis < 3; ++axis)
        result.box.max[axis] = low[axis] + size[axis];
    for (int vertex = 0; vertex < 60; ++vertex)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint64_t kind = random.below(4);
            const std::uint64_t along = kind == 0 ? 0 : kind == 1 ? size[axis] : random.below(size[axis] + 1);
            result.positions.push_back(low[axis] + static_cast<std::uint32_t>(along));
        }
    for (int i = 0; i < 40; ++i) {
        const auto corner = [&] { return static_cast<std::uint8_t>(random.below(60)); };
        result.triangles.push_back({corner(), corner(), corner()});
    }
    return result;
}

/// Rows over about -1 to 1 whose gaps grow, or shrink, up to a thousandfold.
std::vector<float> unevenRows(Random& random, int count) {
    const double growth = random.uniform(-7, 7);
    std::vector<float> rows;
    rows.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        rows.push_back(static_cast<float>(2 * std::expm1(growth * (i + 0.5) / count) / std::expm1(growth) - 1));
    return rows;
}

TEST(CasterBound, HoldsWhateverIsDrawnOfABox) {
    raster::Rasterizer rasterizer;
    Random random(8);
    int drawn = 0;
    int bounded = 0;
    for (int trial = 0; trial < 400; ++trial) {
        SCOPED_TRACE(trial);
        raster::View view = randomView(random);
        const std::vector<float> rows = unevenRows(random, view.viewport.height());
        if (trial % 2 == 1) view.rowPositions = rows;
        const BoxOfTriangles made = randomTriangles(random);
        std::vector<float> depths(std::size_t{kWidth} * kHeight, 1);
        const raster::Cluster cluster = {made.positions.data(), 12, 60, made.triangles, 0};
        const std::uint64_t fragments =
            rasterizer.drawDepth(std::span(&cluster, 1), view, {depths.data(), kWidth, kHeight});
        const CasterBound bound = casterBound(view, made.box);
        drawn += fragments > 0 ? 1 : 0;
        bounded += bound.texels != view.viewport ? 1 : 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const float depth = depths[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)];
                const raster::PixelBox& box = bound.texels;
                const bool isIn = x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1;
                ASSERT_TRUE(depth == 1 || (isIn && depth >= bound.nearest)) << x << " " << y << " " << depth;
            }
    }
    EXPECT_GT(drawn, 50);
    EXPECT_GT(bounded, 250);
}

} // namespace
} // namespace gnomon::exact
