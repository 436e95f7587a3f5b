// Depth passes on rows that lie unevenly: against plain code, exact coverage on every instruction set, no hole and no
// double, depths of the plane.
#include "raster/raster.h"
#include "raster/uneven/row_bands.h"
#include "tests/raster/scenes.h"
#include "tests/raster/uneven_scenes.h"
#include "tests/support/each_target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::raster {
namespace {

TEST(UnevenRows, AreCoveredAsPlainCodeCoversThem) {
    constexpr int kWidth = 133;
    constexpr int kHeight = 300;
    const PixelBox viewport{5, 9, 121, 289};
    for (const auto& [name, rows] : kindsOfRows(viewport.height())) {
        SCOPED_TRACE(name);
        for (const double spacing : {0.7, 3.0, 90.0}) {
            SCOPED_TRACE(spacing);
            const int columns = static_cast<int>(std::min(60.0, std::ceil(kWidth / spacing) + 1));
            const int quads = static_cast<int>(std::min(60.0, std::ceil(kHeight / spacing) + 1));
            View view = flatView(viewport);
            view.rowPositions = rows;
            expectAsPlain(sheet(columns, quads, spacing, 3).clusters(), view, kWidth, kHeight, 1e-3);
        }
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            SCOPED_TRACE(seed);
            View view = insideView(viewport, seed);
            view.rowPositions = rows;
            const Scene scene = soup(300, seed);
            std::vector<float> depths(std::size_t{kWidth} * kHeight, -7);
            const std::uint64_t fragments =
                Rasterizer().drawDepth(scene.clusters(), view, {depths.data(), kWidth, kHeight});
            const PlainDepths plain = plainly(scene.clusters(), view, kWidth, kHeight);
            EXPECT_EQ(fragments, plain.fragments);
            std::size_t apart = 0;
            for (std::size_t i = 0; i < depths.size(); ++i)
                apart += depths[i] == 1 && plain.covers[i] > 0 && plain.depths[i] < 1 ? 1 : 0;
            EXPECT_EQ(apart, 0U);
        }
    }
}

/// A closed fan about `hub` of the viewport, in pixels of an even grid, far beyond it everywhere.
Scene fanAround(double hubX, double hubY, double radius, int triangles) {
    const auto at = [](double x, double y) -> std::array<std::uint32_t, 3> {
        const auto cells = [](double pixels) {
            return static_cast<std::uint32_t>(std::int64_t{kSceneCenter} + std::llround(pixels * kFlatPixel));
        };
        return {cells(x), cells(y), kSceneCenter + (1U << 19U)};
    };
    std::vector<std::array<std::uint32_t, 3>> positions = {at(hubX, hubY)};
    std::vector<Triangle> fan;
    for (int i = 0; i < triangles; ++i) {
        const double angle = 6.283185307 * i / triangles;
        positions.push_back(at(hubX + radius * std::cos(angle), hubY + radius * std::sin(angle)));
        fan.push_back({0, static_cast<std::uint8_t>(1 + i), static_cast<std::uint8_t>(1 + (i + 1) % triangles)});
    }
    Scene scene;
    scene.add(positions, fan);
    return scene;
}

TEST(UnevenRows, AFanOf85TrianglesHasNoHoleAndNoDouble) {
    constexpr int kSide = 2048;
    const PixelBox viewport{0, 0, kSide, kSide};
    for (const auto& [name, rows] : kindsOfRows(kSide)) {
        SCOPED_TRACE(name);
        for (const double hubY : {1023.9995, 700.3, 1.7}) {
            View view = flatView(viewport);
            view.rowPositions = rows;
            const Scene scene = fanAround(1000.3, hubY, 4000, 85);
            const Cluster whole = scene.clusters().front();
            std::vector<float> depths(std::size_t{kSide} * kSide);
            const std::uint64_t fragments = Rasterizer().drawDepth({&whole, 1}, view, {depths.data(), kSide, kSide});
            // As many fragments as samples, and none without: each is covered once.
            EXPECT_EQ(fragments, depths.size()) << "each sample once";
            EXPECT_EQ(std::count(depths.begin(), depths.end(), 1.0F), 0) << "no hole";
        }
    }
}

/// From -1 to 1, with gaps that grow 300 times.
std::vector<float> fanningRows(int count) {
    std::vector<float> rows;
    rows.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        rows.push_back(static_cast<float>(2 * (std::pow(300, (i + 0.5) / count) - 1) / 299 - 1));
    return rows;
}

TEST(UnevenRows, KeepTheirDepthsWithoutWhatIsHidden) {
    constexpr int kWidth = 333;
    constexpr int kHeight = 290;
    constexpr PixelBox kViewport{7, 5, 330, 281};
    const std::vector<float> rows = fanningRows(kViewport.height());
    const std::size_t pixels = std::size_t{kWidth} * kHeight;
    std::uint64_t hidden = 0;
    Rasterizer rasterizer;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        const Scene scene = crowd(seed);
        const std::vector<CellBox> boxes = boxesOf(scene.clusters());
        for (View view : {flatView(kViewport), insideView(kViewport, seed)}) {
            view.rowPositions = rows;
            std::vector<float> whole(pixels, 2);
            rasterizer.drawDepth(scene.clusters(), view, {whole.data(), kWidth, kHeight});
            tests::onEachTarget([&](const char* target) {
                SCOPED_TRACE(target);
                std::vector<float> depths(pixels, 2);
                const DepthTarget map = {depths.data(), kWidth, kHeight};
                hidden += rasterizer.drawNearestDepth(scene.clusters(), boxes, view, map).hidden.clustersHidden;
                EXPECT_TRUE(depths == whole);
            });
        }
    }
    EXPECT_GT(hidden, 50U);
}

TEST(UnevenRows, BandsKeepTheirRowsABucketApart) {
    auto kinds = kindsOfRows(1000);
    kinds.emplace_back("logarithmic, 1e6, finer than 256 units can tell", logarithmicRows(16384, 1e6));
    for (const auto& [name, rows] : kinds) {
        SCOPED_TRACE(name);
        RowBands bands;
        bands.reset(rows, 7);
        int next = 7;
        for (const RowBand& band : bands.bands()) {
            EXPECT_EQ(band.first, next);
            next = band.end;
            EXPECT_LE(band.count(), kMaxBandRows);
            for (int i = 0; i + 1 < band.count(); ++i) {
                const auto at = static_cast<std::size_t>(i);
                const std::int32_t gap = band.rows[at + 1] - band.rows[at];
                EXPECT_GT(gap, 1 << band.bucketBits);
                EXPECT_LE(gap, 2 * 16 * 520);
            }
        }
        EXPECT_EQ(next, 7 + static_cast<int>(rows.size()));
    }
}

constexpr int kMapSide = 2048;
constexpr double kDensityRatio = 1e6; // of the rows of a map
constexpr double kCellsPerW = 2048;

/// As a map with logarithmic rows is drawn: y is -1, and w is 1 at the lowest of its rows and 1e6 at the highest.
View logMapView() {
    View view;
    view.eyeCell = glm::ivec3(static_cast<int>(kSceneCenter));
    view.clipFromCell = glm::mat4(0);
    view.clipFromCell[0][0] = static_cast<float>(1 / kCellsPerW);
    view.clipFromCell[1][2] = static_cast<float>(1 / kCellsPerW);
    view.clipFromCell[2][3] = static_cast<float>(1 / kCellsPerW);
    view.clipFromCell[3] = {0, -1, 0, 1};
    view.viewport = {0, 0, kMapSide, kMapSide};
    return view;
}

using GridCell = std::array<std::uint32_t, 3>;

/// The grid position that is nearest to clip space (x w, -1, depth w, w).
GridCell atClip(double x, double w, double depth) {
    const auto cell = [](double clip) {
        return static_cast<std::uint32_t>(std::int64_t{kSceneCenter} + std::llround(clip * kCellsPerW));
    };
    return {cell(x * w), cell(depth * w), cell(w - 1)};
}

/// The same at a column and a row of the map.
GridCell atTexel(double column, double row, double depth) {
    return atClip(2 * column / kMapSide - 1, std::pow(kDensityRatio, row / kMapSide), depth);
}

void addTriangle(Scene& scene, const GridCell& a, const GridCell& b, const GridCell& c) {
    scene.add({a, b, c}, {{0, 1, 2}});
}

/// A closed fan about (column, row) that reaches beyond the map on both sides, and nearly to its ends.
Scene fanInMap(double column, double row, int triangles) {
    std::vector<GridCell> positions = {atTexel(column, row, 0.5)};
    std::vector<Triangle> fan;
    for (int i = 0; i < triangles; ++i) {
        const double angle = 6.283185307 * i / triangles;
        positions.push_back(atTexel(1024 + 1300 * std::cos(angle), 1024 + 1000 * std::sin(angle), 0.5));
        fan.push_back({0, static_cast<std::uint8_t>(1 + i), static_cast<std::uint8_t>(1 + (i + 1) % triangles)});
    }
    Scene scene;
    scene.add(positions, fan);
    return scene;
}

/// Triangles of every size in texels; of each fourth a corner lies behind the warp's centre, of each eighth two.
Scene mixtureInMap(std::uint64_t seed) {
    Random random(seed);
    Scene scene;
    for (int i = 0; i < 48; ++i) {
        const double column = random.uniform(-100, kMapSide + 100);
        const double row = random.uniform(-40, kMapSide);
        const double size = std::exp2(random.uniform(-2, 10));
        std::array<GridCell, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double up = std::min(row + size * random.uniform(-1, 1), kMapSide + 20.0);
            corners[k] = atTexel(
                std::clamp(column + size * random.uniform(-1, 1), -900.0, 2900.0), up, random.uniform(-0.5, 1.5));
            const bool isBehind = (i % 4 == 3 && k == 0) || (i % 8 == 7 && k == 1);
            if (isBehind) corners[k] = atClip(random.uniform(-3, 3), -random.uniform(0, 1e5), random.uniform(0, 1));
        }
        addTriangle(scene, corners[0], corners[1], corners[2]);
    }
    return scene;
}

/// The hard cases of rasterising that are about one triangle or few, with their names.
std::vector<std::pair<const char*, Scene>> hardCasesInMap() {
    Scene noArea;
    addTriangle(noArea, atTexel(10, 100, 0.5), atTexel(10, 700, 0.5), atTexel(10, 1500, 0.5));
    addTriangle(noArea, atTexel(900, 900, 0.5), atTexel(900, 900, 0.1), atTexel(900, 900, 0.9));
    Scene tiny;
    for (int i = 0; i < 200; ++i) {
        const double column = 7.3 + 10 * i;
        const double row = 300.2 + 8.1 * i;
        addTriangle(
            tiny, atTexel(column, row, 0.2), atTexel(column + 0.8, row + 0.1, 0.3), atTexel(column, row + 0.7, 0));
    }
    Scene huge;
    addTriangle(huge, atClip(-900, 1000, 0.5), atClip(900, 1000, 0.2), atClip(0.1, 0.001, 0.9));
    Scene behind; // no corner before the centre, one, and two
    addTriangle(behind, atClip(0, -1, 0.5), atClip(2, -50, 0.5), atClip(-2, -3, 0.5));
    addTriangle(behind, atTexel(1000, 1800, 0.5), atClip(300, -40, 0.5), atClip(-300, -40, 0.25));
    addTriangle(behind, atTexel(100, 1400, 0.5), atTexel(1900, 1500, 0.4), atClip(1, -1e4, 0.3));
    Scene clamped;
    addTriangle(clamped, atTexel(100, 200, -1), atTexel(1900, 300, 3), atTexel(900, 1900, 0.5));
    Scene slivers;
    for (int i = 0; i < 16; ++i)
        addTriangle(
            slivers,
            atTexel(100.5 + 100 * i, 20, 0.25),
            atTexel(100.5 + 100 * i + i / 4096.0, 1600, 0.75),
            atTexel(100.502 + 100 * i, 1610, 0.75));
    return {
        {"no area", noArea},
        {"smaller than a texel", tiny},
        {"larger than the map", huge},
        {"behind the centre", behind},
        {"leaves the depth range", clamped},
        {"slivers", slivers},
        {"85 share a corner", fanInMap(1000.3, 700.3, 85)},
        {"85 share a corner near the end", fanInMap(3.1, 1990.7, 85)},
        {"all sizes, 0", mixtureInMap(0)},
        {"all sizes, 1", mixtureInMap(1)}};
}

TEST(SlowUnevenRows, HardCasesAreCoveredAsPlainCodeCoversThemAt2048Square) {
    View view = logMapView();
    const std::vector<float> logarithmic = logarithmicRows(kMapSide, kDensityRatio);
    const std::vector<float> random = randomRows(kMapSide, kDensityRatio, 9);
    for (const auto& hardCase : hardCasesInMap())
        for (const std::vector<float>* rows : {&logarithmic, &random}) {
            SCOPED_TRACE(hardCase.first);
            const std::vector<Cluster> clusters = hardCase.second.clusters();
            view.rowPositions = *rows;
            const PlainDepths plain = plainly(clusters, view, kMapSide, kMapSide);
            EXPECT_EQ(plain.fragments > 0, std::string(hardCase.first) != "no area");
            tests::onEachTarget([&](const char* target) {
                SCOPED_TRACE(target);
                const DrawnDepths found = drawn(clusters, view, kMapSide, kMapSide);
                EXPECT_EQ(found.fragments, plain.fragments);
                std::size_t apart = 0;
                for (std::size_t i = 0; i < found.depths.size(); ++i)
                    apart += (found.depths[i] < 1) != (plain.depths[i] < 1) ? 1 : 0;
                EXPECT_EQ(apart, 0U);
            });
        }
}

} // namespace
} // namespace gnomon::raster
