// The sorted samples and their mask against a look at each.
#include "exact/sample_grid.h"
#include "tests/exact/scenes.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace gnomon::exact {
namespace {

const double kError = coordinateErrorFor(100);

/// Upright triangles within 100 cells of the origin, a point on each.
Scene someScene(RandomWholes& random, std::size_t count, int maps) {
    Scene scene;
    while (scene.points.size() < count) {
        const glm::i64vec3 a = random.point(-90, 90);
        ScenePoint point;
        point.triangle = scene.add(std::vector<Corners>{{a, a + glm::i64vec3(9, 0, 1), a + glm::i64vec3(0, 9, 2)}});
        point.second = static_cast<float>(random.real(0, 0.5));
        point.third = static_cast<float>(random.real(0, 0.5));
        point.map = static_cast<std::int32_t>(random.whole(0, maps - 1));
        scene.points.push_back(point);
    }
    return scene;
}

SampleSpace spaceOver(int maps) {
    return spaceOf(roundedLight({0.1, 0.2, 1}), {0, 0, 1e4}, maps);
}

/// Samples, and where they lay by the order of the list before a grid sorted them.
struct Listed {
    SampleList samples;
    std::vector<glm::dvec3> places;

    Listed(const Scene& scene, int maps) {
        fill(samples, scene, spaceOver(maps));
        for (std::size_t i = 0; i < samples.size(); ++i)
            places.emplace_back(samples.u[i], samples.v[i], samples.h[i]);
    }

    /// Puts them in the order of the list again.
    void restore() {
        for (std::size_t i = 0; i < places.size(); ++i) {
            samples.u[i] = places[i].x;
            samples.v[i] = places[i].y;
            samples.h[i] = places[i].z;
        }
    }
};

/// The cell of sample `i` of the list, by the map's matrix.
std::array<int, 2> cellOf(const SampleGrid& grid, const Listed& listed, std::size_t i) {
    const GridMap& map = grid.maps()[listed.samples.mapOf(i)];
    const glm::dvec3 p = map.cellsFromLight * glm::dvec4(listed.places[i], 1);
    EXPECT_GE(p.z, 2 * map.minW);
    EXPECT_TRUE(p.x / p.z >= 0 && p.x / p.z <= grid.side()) << p.x / p.z;
    EXPECT_TRUE(p.y / p.z >= 0 && p.y / p.z <= grid.side()) << p.y / p.z;
    return {static_cast<int>(p.x / p.z), static_cast<int>(p.y / p.z)};
}

/// The samples of a cell lie in it, with their own values; `met` counts them.
void expectInCell(
    const SampleGrid& grid, const Listed& listed, std::size_t map, std::array<int, 2> cell, std::vector<int>& met) {
    for (std::size_t at = grid.first(map, cell[0], cell[1]); at < grid.first(map, cell[0] + 1, cell[1]); ++at) {
        const std::size_t i = grid.source[at];
        ++met[i];
        const SampleList& samples = listed.samples;
        EXPECT_EQ(samples.mapOf(i), map);
        EXPECT_EQ(cellOf(grid, listed, i), cell);
        EXPECT_EQ(glm::dvec3(samples.u[at], samples.v[at], samples.h[at]), listed.places[i]);
        EXPECT_EQ(grid.triangle[at], samples.triangle[i]);
    }
}

/// The least h of the samples in block (x, y).
double plainLowest(const SampleGrid& grid, const SampleList& samples, std::size_t map, int x, int y) {
    double min = std::numeric_limits<double>::infinity();
    for (int row = 8 * y; row < std::min(grid.side(), 8 * y + 8); ++row)
        for (std::size_t at = grid.first(map, 8 * x, row); at < grid.first(map, std::min(grid.side(), 8 * x + 8), row);
             ++at)
            min = std::min(min, samples.h[at]);
    return min;
}

/// Every sample once, in the cell that its place falls into, with its own values; and the least h of each block.
void expectSorted(const SampleGrid& grid, const Listed& listed) {
    const SampleList& samples = listed.samples;
    ASSERT_EQ(grid.size(), samples.size());
    std::vector<int> met(samples.size());
    std::uint32_t last = 0;
    for (std::size_t map = 0; map < grid.maps().size(); ++map) {
        for (int y = 0; y < grid.side(); ++y)
            for (int x = 0; x < grid.side(); ++x) {
                EXPECT_EQ(grid.first(map, x, y), last);
                last = grid.first(map, x + 1, y);
                expectInCell(grid, listed, map, {x, y}, met);
            }
        for (int y = 0; y < grid.mask(map).blocksHigh(); ++y)
            for (int x = 0; x < grid.mask(map).blocksWide(); ++x) {
                const double min = plainLowest(grid, listed.samples, map, x, y);
                const float low = grid.mask(map).lowest(x, y);
                EXPECT_LE(low, min);
                EXPECT_GE(std::nextafter(low, ReceiverMask::kNone), min);
            }
    }
    EXPECT_EQ(last, samples.size());
    EXPECT_EQ(std::count(met.begin(), met.end(), 1), static_cast<std::ptrdiff_t>(met.size()));
}

/// Planes of the kinds that a plan makes, and others: scaled, warped, turned about.
std::vector<glm::dmat3> somePlanes(RandomWholes& random, int count) {
    std::vector<glm::dmat3> planes;
    for (int i = 0; i < count; ++i) {
        const double scale = std::exp2(random.real(-10, 10));
        const double strength = random.real(-1, 1) / 300;
        planes.push_back(
            {{scale, -0.1 * scale, strength}, {0.1 * scale, -scale, strength}, {random.real(-9, 9), 0, 1}});
    }
    return planes;
}

TEST(SampleGrid, HoldsEverySampleOnceInItsCell) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        RandomWholes random(seed);
        const int maps = static_cast<int>(random.whole(1, 3));
        const Scene scene = someScene(random, static_cast<std::size_t>(random.whole(1, 400)), maps);
        Listed listed(scene, maps);
        ASSERT_EQ(listed.samples.size(), scene.points.size());
        SampleGrid grid;
        const std::vector<glm::dmat3> planes = somePlanes(random, maps);
        for (const int side : {1, 4, 37, 128})
            for (const int threads : {1, 2}) {
                listed.restore();
                tbb::task_arena(threads).execute([&] { grid.sort(listed.samples, planes, side, kError); });
                expectSorted(grid, listed);
            }
    }
}

TEST(SampleGrid, SortsMoreThanOnePiece) {
    RandomWholes random(1);
    Scene scene = someScene(random, 50, 2);
    for (std::size_t i = 0; scene.points.size() < 40000; ++i) {
        ScenePoint point = scene.points[i];
        point.second = static_cast<float>(random.real(0, 0.5));
        scene.points.push_back(point);
    }
    Listed listed(scene, 2);
    SampleGrid grid;
    grid.sort(listed.samples, somePlanes(random, 2), 64, kError);
    expectSorted(grid, listed);
}

/// What a grid holds, by place.
struct Places {
    std::vector<std::uint32_t> source, triangle;
    std::vector<glm::dvec3> at;
    std::vector<std::uint32_t> first; // of each cell, and the end

    Places(const SampleGrid& grid, const SampleList& samples) {
        for (std::size_t i = 0; i < grid.size(); ++i) {
            source.push_back(grid.source[i]);
            triangle.push_back(grid.triangle[i]);
            at.emplace_back(samples.u[i], samples.v[i], samples.h[i]);
        }
        for (std::size_t map = 0; map < grid.maps().size(); ++map)
            for (int y = 0; y < grid.side(); ++y)
                for (int x = 0; x < grid.side(); ++x)
                    first.push_back(grid.first(map, x, y));
        first.push_back(static_cast<std::uint32_t>(grid.size()));
    }

    /// Takes out those that leave, one after the other.
    void remove(const std::vector<bool>& leaves) {
        std::vector<std::uint32_t> kept(leaves.size() + 1);
        for (std::size_t i = 0; i < leaves.size(); ++i) {
            kept[i + 1] = kept[i] + (leaves[i] ? 0U : 1U);
            source[kept[i]] = source[i];
            triangle[kept[i]] = triangle[i];
            at[kept[i]] = at[i];
        }
        source.resize(kept.back());
        triangle.resize(kept.back());
        at.resize(kept.back());
        for (std::uint32_t& cell : first)
            cell = kept[cell];
    }

    bool operator==(const Places&) const = default;
};

/// Which samples leave: none, all, any, or long runs.
std::vector<bool> someLeaving(RandomWholes& random, std::size_t count, int kind) {
    std::vector<bool> leaves(count);
    const double from = random.real(0, 0.7);
    for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count);
        leaves[i] = kind == 1 || (kind == 2 && random.whole(0, 2) == 0) || (kind == 3 && share > from && share < 0.9);
    }
    return leaves;
}

TEST(SampleGrid, RemovesWhatLeavesAndKeepsTheOrder) {
    RandomWholes random(7);
    Scene scene = someScene(random, 50, 2);
    for (std::size_t i = 0; scene.points.size() < 70000; ++i)
        scene.points.push_back(scene.points[i]);
    Listed listed(scene, 2);
    const std::vector<glm::dmat3> planes = somePlanes(random, 2);
    for (const int kind : {0, 1, 2, 3, 3, 3}) {
        SCOPED_TRACE(kind);
        listed.restore();
        SampleGrid grid;
        grid.sort(listed.samples, planes, 37, kError);
        Places expected(grid, listed.samples);
        const std::vector<bool> leaves = someLeaving(random, grid.size(), kind);
        FrameArray<std::uint8_t> statuses;
        statuses.ensureCapacity(grid.size());
        for (std::size_t i = 0; i < grid.size(); ++i)
            statuses[i] = static_cast<std::uint8_t>(grid.source[i]);
        std::vector<std::uint8_t> left(grid.size());
        grid.remove(
            listed.samples,
            statuses,
            [&](std::size_t place) { return leaves[place]; },
            [&](std::size_t place) { left[place] = 1; });
        EXPECT_TRUE(std::equal(leaves.begin(), leaves.end(), left.begin()));
        expected.remove(leaves);
        EXPECT_TRUE(Places(grid, listed.samples) == expected);
        for (std::size_t i = 0; i < grid.size(); ++i)
            ASSERT_EQ(statuses[i], static_cast<std::uint8_t>(grid.source[i]));
    }
}

/// Whether the map's cells are those of a plane without a warp.
bool isUnwarped(const GridMap& map) {
    const glm::dmat4x3& m = map.cellsFromLight;
    return m[0][2] == 0 && m[1][2] == 0 && m[3][2] == 1 && m[1][0] == 0 && m[0][1] == 0;
}

TEST(SampleGrid, LeavesOutWarpsThatCannotBeTrusted) {
    RandomWholes random(2);
    const Scene scene = someScene(random, 200, 1);
    Listed listed(scene, 1);
    double minU = 0;
    for (const glm::dvec3& place : listed.places)
        minU = std::min(minU, place.x);
    const double nan = std::nan("");
    const std::vector<glm::dmat3> useless = {
        {{1, 0, 0.1}, {0, 1, 0}, {0, 0, 1}},         // w below 0 at some samples
        {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},          // and at all
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 0}},           // 0
        {{1, 0, 1}, {0, 1, 0}, {0, 0, 1e-5 - minU}}, // varies too much
        {{nan, 0, 0}, {0, 1, 0}, {0, 0, 1}},         // no number
        {{1, 0, 0}, {0, 1, 0}, {0, 0, nan}},         //
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}},           // all samples in one place
        {{1e-300, 0, 0}, {0, 1e-300, 0}, {1, 1, 1}}, // nearly so
        {{1, 0, 0}, {0, 1, 0}, {0x1p60, 0, 1}},      // far off
    };
    SampleGrid grid;
    for (const glm::dmat3& plane : useless) {
        SCOPED_TRACE(&plane - useless.data());
        listed.restore();
        grid.sort(listed.samples, std::vector{plane}, 32, kError);
        EXPECT_TRUE(isUnwarped(grid.maps()[0]));
        expectSorted(grid, listed);
    }
    listed.restore();
    grid.sort(listed.samples, std::vector{glm::dmat3{{1, 0, 0.004}, {0, 1, 0}, {0, 0, 1}}}, 32, kError);
    EXPECT_FALSE(isUnwarped(grid.maps()[0]));
}

TEST(SampleGrid, OfNothingHasEmptyMaps) {
    SampleList samples;
    samples.reset(spaceOver(2), 10);
    SampleGrid grid;
    grid.sort(samples, std::vector(2, glm::dmat3(1)), 16, kError);
    EXPECT_EQ(grid.size(), 0U);
    EXPECT_EQ(grid.first(1, 16, 15), 0U);
    for (std::size_t map = 0; map < 2; ++map) {
        EXPECT_TRUE(grid.maps()[map].isEmpty);
        EXPECT_FALSE(grid.mask(map).mayShadow({0, 0, 15, 15}, 1e30F));
    }
}

TEST(SampleGrid, CellsHoldWhatLiesOutside) {
    EXPECT_EQ(cellAt(-1e300, 8), 0);
    EXPECT_EQ(cellAt(-0.5, 8), 0);
    EXPECT_EQ(cellAt(0.999, 8), 0);
    EXPECT_EQ(cellAt(7.999, 8), 7);
    EXPECT_EQ(cellAt(8, 8), 7);
    EXPECT_EQ(cellAt(1e300, 8), 7);
    EXPECT_EQ(cellAt(std::nan(""), 8), 0);
}

} // namespace
} // namespace gnomon::exact
