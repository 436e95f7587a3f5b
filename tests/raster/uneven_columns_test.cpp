// Depth passes on columns in runs: against plain code, and against even ones.
#include "tests/raster/scenes.h"
#include "tests/raster/uneven_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace gnomon::raster {
namespace {

TEST(UnevenColumns, AreCoveredAsPlainCodeCoversThem) {
    constexpr int kWidth = 290;
    constexpr int kHeight = 133;
    const PixelBox viewport{5, 9, 283, 121};
    const std::vector<float> even = evenRows(viewport.height());
    const std::vector<float> logarithmic = logarithmicRows(viewport.height(), 1e3);
    for (const std::vector<float>* rows : {&even, &logarithmic})
        for (const std::span<const double> densities :
             {std::span<const double>(kSpreadDensities), std::span<const double>(kAlternatingDensities)}) {
            SCOPED_TRACE(std::to_string(densities.size()) + (rows == &even ? " even" : " logarithmic"));
            const std::vector<ColumnRun> runs = runsOf(viewport, densities);
            for (const double spacing : {0.7, 3.0, 90.0}) {
                SCOPED_TRACE(spacing);
                const int quads = static_cast<int>(std::min(60.0, std::ceil(kWidth / spacing) + 1));
                View view = flatView(viewport);
                view.rowPositions = *rows;
                view.columnRuns = runs;
                expectAsPlain(sheet(quads, quads, spacing, 3).clusters(), view, kWidth, kHeight, 1e-3);
            }
            for (std::uint64_t seed = 0; seed < 3; ++seed) {
                SCOPED_TRACE(seed);
                View view = insideView(viewport, seed);
                view.rowPositions = *rows;
                view.columnRuns = runs;
                const Scene scene = soup(300, seed);
                std::vector<float> depths(std::size_t{kWidth} * kHeight, -7);
                const std::uint64_t fragments =
                    Rasterizer().drawDepth(scene.clusters(), view, {depths.data(), kWidth, kHeight});
                EXPECT_EQ(fragments, plainly(scene.clusters(), view, kWidth, kHeight).fragments);
            }
        }
}

/// A run over all of the viewport is what it would be without.
TEST(UnevenColumns, OfOneRunAreEven) {
    constexpr int kSide = 200;
    const PixelBox viewport{3, 5, 187, 190};
    const std::vector<float> rows = logarithmicRows(viewport.height(), 1e3);
    constexpr std::array kOne = {1.0};
    const std::vector<ColumnRun> runs = runsOf(viewport, kOne);
    for (const double spacing : {0.7, 3.0, 60.0}) {
        const int quads = static_cast<int>(std::min(60.0, std::ceil(kSide / spacing) + 1));
        const Scene scene = sheet(quads, quads, spacing, 4);
        View view = flatView(viewport);
        view.rowPositions = rows;
        const DrawnDepths even = drawn(scene.clusters(), view, kSide, kSide);
        view.columnRuns = runs;
        const DrawnDepths ofRun = drawn(scene.clusters(), view, kSide, kSide);
        EXPECT_EQ(even.fragments, ofRun.fragments) << spacing;
        for (std::size_t i = 0; i < even.depths.size(); ++i)
            ASSERT_NEAR(even.depths[i], ofRun.depths[i], 1e-5) << spacing;
    }
}

} // namespace
} // namespace gnomon::raster
