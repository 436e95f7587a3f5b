// The split of a texel budget and the packing of its maps.
#include "core/error.h"
#include "shadow/texels/packing.h"
#include "shadow/texels/texel_budget.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

bool overlap(const TexelRectangle& a, const TexelRectangle& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

void expectSoundPacking(const Packing& packing) {
    for (std::size_t i = 0; i < packing.rectangles.size(); ++i) {
        const TexelRectangle& r = packing.rectangles[i];
        EXPECT_GE(r.x, 0);
        EXPECT_GE(r.y, 0);
        EXPECT_LE(r.x + r.width, packing.width);
        EXPECT_LE(r.y + r.height, packing.height);
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_FALSE(overlap(r, packing.rectangles[j])) << i << " and " << j;
    }
}

std::vector<TexelDemand> demandsOf(const ShadowMapSetup& setup) {
    return setup.demands;
}

double used(const ShadowMapSetup& setup, const ShadowOptions& options) {
    double area = 0;
    for (const ShadowMap& map : setup.maps)
        area += static_cast<double>(map.rectangle.area());
    return area / static_cast<double>(options.texels);
}

TEST(Packing, RectanglesAreDisjointAndInside) {
    Random random(11);
    for (int round = 0; round < 300; ++round) {
        std::vector<TexelRectangle> sizes(1 + random.below(40));
        for (TexelRectangle& size : sizes)
            size = {0, 0, 1 + static_cast<int>(random.below(200)), 1 + static_cast<int>(random.below(200)), false};
        const Packing packing = packed(sizes, 4096);
        ASSERT_EQ(packing.rectangles.size(), sizes.size());
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            const TexelRectangle& r = packing.rectangles[i];
            EXPECT_EQ(r.transposed ? r.height : r.width, sizes[i].width);
            EXPECT_EQ(r.transposed ? r.width : r.height, sizes[i].height);
        }
        expectSoundPacking(packing);
    }
}

TEST(Packing, AStripIsAsWideAsItsFirstRowAndAsTheWidestOfAll) {
    const std::vector<TexelRectangle> sizes{{0, 0, 10, 100, false}, {0, 0, 50, 10, false}, {0, 0, 20, 5, false}};
    using Strategy = PackingStrategy;
    const auto widthOf = [&](int row) {
        return packed(sizes, {Strategy::Transposition::AsGiven, Strategy::Order::Height, row, 1}, 1000).width;
    };
    EXPECT_EQ(widthOf(1), 50);
    EXPECT_EQ(widthOf(2), 60);
    EXPECT_EQ(widthOf(3), 80);
}

TEST(Packing, WhatFitsNowhereIsSaid) {
    const std::vector<TexelRectangle> sizes{{0, 0, 100, 10, false}, {0, 0, 10, 100, false}};
    EXPECT_EQ(packed(sizes, 50).width, 0);
    // What fits at no scale yet is tried one above the other as it shrinks: that needs the least width.
    const std::vector<TexelRectangle> smaller{{0, 0, 40, 10, false}, {0, 0, 40, 20, false}};
    const Packing column = packed(smaller, bestStrategy(sizes, 50), 50);
    EXPECT_EQ(column.width, 40);
    EXPECT_EQ(column.height, 40);
}

/// The range of errors that the rounding of `demand` / error to whole texels allows: within one texel of `texels`.
bool withinOneTexel(double demand, int texels, double error) {
    return demand / texels <= error * (1 + 1e-9) && demand / (texels - 1) >= error * (1 - 1e-9);
}

void checkSplit(std::uint64_t seed, int& tested, int& wellUsed) {
    Random random(seed);
    const ShadowView view = randomView(random);
    ShadowOptions options = randomOptions(random, view.frustum);
    options.stabilized = false;
    options.texels = std::uint64_t{1} << (20 + random.below(5));
    const ShadowMapSetup setup = shadowMapSetup(view, options);
    const std::vector<TexelDemand> demands = demandsOf(setup);
    const TexelLimits limits{options.texels, setup.maps.front().gutter, options.minSide, options.maxSide, 0};
    const TexelLayout layout = splitTexels(demands, limits);
    expectSoundPacking(layout.packing);
    EXPECT_LE(layout.packing.area(), options.texels);
    double worst = 0;
    for (std::size_t i = 0; i < demands.size(); ++i)
        worst = std::max(worst, mapError(layout, i, demands[i]));
    // Equal squares, computed apart.
    const auto side =
        static_cast<int>(std::sqrt(static_cast<double>(options.texels) / static_cast<double>(demands.size())));
    const int inner = side - 2 * layout.gutter;
    double squaresOneTexelOff = 0;
    for (const TexelDemand& demand : demands) {
        squaresOneTexelOff = std::max(squaresOneTexelOff, std::max(demand.s, demand.t) / (inner - 1));
    }
    const bool squaresFit = static_cast<int>(demands.size()) * side <= options.maxSide;
    EXPECT_TRUE(!squaresFit || worst <= squaresOneTexelOff) << "seed " << seed;
    const int largest = options.maxSide - 2 * layout.gutter;
    bool bounded = layout.equalSquares; // the limits on a side, not the budget, decide
    for (std::size_t i = 0; i < demands.size(); ++i)
        for (const int texels : {layout.texelsS(i), layout.texelsT(i)})
            bounded = bounded || texels <= options.minSide || texels >= largest;
    if (bounded) return;
    ++tested;
    // Slices of unequal depth ratio ask for maps of unequal shape, which pack less well.
    EXPECT_GE(used(setup, options), 0.75) << "seed " << seed;
    wellUsed += used(setup, options) >= 0.9 ? 1 : 0;
    for (std::size_t i = 0; i < demands.size(); ++i)
        EXPECT_TRUE(
            withinOneTexel(demands[i].s, layout.texelsS(i), worst) ||
            withinOneTexel(demands[i].t, layout.texelsT(i), worst))
            << "seed " << seed << " map " << i << " of " << demands.size();
}

TEST(Budget, ErrorIsEqualWithinATexelAndTheBudgetWellUsed) {
    int tested = 0;
    int wellUsed = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed)
        checkSplit(seed, tested, wellUsed);
    EXPECT_GT(tested, 300);
    EXPECT_GE(wellUsed, tested * 97 / 100);
}

TEST(Budget, OneMapIsEqs13And14) {
    const std::vector<TexelDemand> demands{{3000, 1000}};
    const TexelLayout layout = splitTexels(demands, {1 << 20, 0, 1, 16384, 0});
    EXPECT_NEAR(layout.texelsS(0), std::sqrt(3.0 * (1 << 20)), 2);
    EXPECT_NEAR(layout.texelsT(0), std::sqrt((1 << 20) / 3.0), 2);
}

TEST(Budget, SidesKeepToTheirLimits) {
    const std::vector<TexelDemand> demands{{1e9, 1}, {10, 10}};
    const TexelLayout layout = splitTexels(demands, {1 << 22, 2, 8, 4096, 0});
    EXPECT_LE(layout.packing.width, 4096);
    EXPECT_LE(layout.packing.height, 4096);
    EXPECT_GE(layout.texelsT(0), 8);
    EXPECT_GE(layout.texelsS(1), 8);
}

TEST(Budget, OneSliceToSixtyFourAreTaken) {
    ShadowOptions options;
    for (const int slices : {1, 64}) {
        options.scheme.slices = slices;
        EXPECT_EQ(shadowMapSetup({}, options).maps.size(), static_cast<std::size_t>(slices));
    }
    for (const int slices : {-1, 0, 65}) {
        options.scheme.slices = slices;
        EXPECT_THROW(shadowMapSetup({}, options), Error) << slices;
    }
}

TEST(Budget, TooSmallABudgetIsRefused) {
    const std::vector<TexelDemand> demands(100, TexelDemand{1, 1});
    EXPECT_THROW(splitTexels(demands, {100, 1, 4, 16384, 0}), Error);
}

TEST(Budget, TheRequiredTexelsSuffice) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const ShadowView view = randomView(random);
        ShadowOptions options = randomOptions(random, view.frustum);
        const ShadowMapSetup setup = shadowMapSetup(view, options);
        const double now = setup.worst().worst();
        const double wanted = now * random.uniform(0.5, 0.9);
        const std::uint64_t required = requiredTexels(setup, options, wanted);
        // Where none would do, the most that the sides allow do not either.
        const auto side = static_cast<std::uint64_t>(options.maxSide);
        options.texels = required > 0 ? required : side * side;
        const ShadowMapSetup then = shadowMapSetup(view, options);
        EXPECT_EQ(then.worst().worst() <= wanted * (1 + 1e-9), required > 0) << "seed " << seed;
    }
}

} // namespace
} // namespace gnomon::shadow
