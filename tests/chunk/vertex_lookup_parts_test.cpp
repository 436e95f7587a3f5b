// Vertices by their index in the source, and the points at which too many of them lie, each beside a plain map.
#include "core/random.h"
#include "preprocess/chunk/heavy_points.h"
#include "preprocess/chunk/indexed_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace gnomon::chunk {
namespace {

/// Vertices of `indices`, each told by its position.
std::vector<ChunkVertex> verticesOf(const std::vector<std::uint64_t>& indices) {
    std::vector<ChunkVertex> vertices;
    for (const std::uint64_t index : indices) {
        vertices.emplace_back().index = index;
        vertices.back().position = glm::dvec3(index, 0, 1);
    }
    return vertices;
}

/// Runs of a scan, and indices far apart.
std::set<std::uint64_t> chosenIndices(Random& random, int trial) {
    std::set<std::uint64_t> chosen;
    const std::uint64_t spread = trial % 3 == 0 ? 300 : trial % 3 == 1 ? 4'000'000'000U : std::uint64_t{1} << 40U;
    while (chosen.size() < 1 + static_cast<std::size_t>(trial)) {
        const std::uint64_t first = random.below(spread);
        for (std::uint32_t i = 0; i < 1 + random.below(20); ++i)
            chosen.insert(first + i);
    }
    return chosen;
}

TEST(IndexedVertices, FindEachVertexByItsIndex) {
    Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const std::set<std::uint64_t> chosen = chosenIndices(random, trial);
        std::vector<std::uint64_t> own;
        std::vector<std::uint64_t> foreign;
        for (const std::uint64_t index : chosen)
            (random.below(4) == 0 ? foreign : own).push_back(index);
        for (std::size_t i = foreign.size(); i-- > 1;)
            std::swap(foreign[i], foreign[random.below(i + 1)]);
        std::vector<std::uint64_t> all = own;
        all.insert(all.end(), foreign.begin(), foreign.end());
        IndexedVertices vertices(verticesOf(all), own.size());
        ASSERT_EQ(vertices.size(), all.size());
        EXPECT_EQ(vertices.ownCount(), own.size());
        for (const std::uint64_t index : all) {
            const std::uint32_t place = vertices.find(index);
            ASSERT_LT(place, all.size());
            ASSERT_EQ(vertices[place].index, index);
            ASSERT_EQ(vertices[place].position.x, static_cast<double>(index));
            ASSERT_EQ(place < own.size(), std::binary_search(own.begin(), own.end(), index));
        }
        const read::TriangleCorners corners{all.front(), all.back(), all[all.size() / 2]};
        const simplify::Triangle found = vertices.find(corners);
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(vertices[found[k]].index, corners[k]);
        EXPECT_EQ(std::move(vertices).take().size(), all.size());
    }
}

TEST(HeavyPoints, TellPointsAndWhetherAVertexLiesWhereTheFirstDid) {
    HeavyPoints points({{5, 0, 0}, {1, 2, 3}, {9, 9, 9}}, 2);
    ASSERT_EQ(points.size(), 2U) << "the first two, in order";
    EXPECT_EQ(points[0], (hierarchy::GridPoint{1, 2, 3}));
    EXPECT_EQ(points[1], (hierarchy::GridPoint{5, 0, 0}));
    EXPECT_FALSE(points.find({9, 9, 9}, {9, 9, 9}));
    EXPECT_FALSE(points.find({1, 2, 4}, {1, 2, 4}));
    EXPECT_EQ(points.find({5, 0, 0}, {5.1, 0, 0}), 2U) << "the first there";
    EXPECT_EQ(points.find({5, 0, 0}, {5.2, 0, 0}), 3U);
    EXPECT_EQ(points.find({5, 0, 0}, {5.1, 0, 0}), 2U);
    EXPECT_EQ(points.find({1, 2, 3}, {1, 2, 3}), 0U);
    EXPECT_EQ(HeavyPoints({}, 7).size(), 0U);
}

TEST(HeavyPoints, LeaveOutRepeatedTrianglesByWhatIsWrongWithThem) {
    HeavyPoints points({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 3);
    DroppedTriangles dropped;
    const auto isRepeated = [&](const read::TriangleCorners& corners, const std::array<std::uint32_t, 3>& found) {
        return points.isRepeated(corners, found, dropped);
    };
    EXPECT_FALSE(isRepeated({1, 2, 3}, {0, 2, 4})) << "the first of its points";
    EXPECT_TRUE(isRepeated({4, 5, 6}, {0, 2, 4}));
    EXPECT_TRUE(isRepeated({6, 5, 4}, {4, 2, 1})) << "in any order, and from anywhere at a point";
    EXPECT_EQ(dropped.doubled, 2U);
    EXPECT_FALSE(isRepeated({1, 1, 3}, {2, 2, 4}));
    EXPECT_TRUE(isRepeated({7, 8, 3}, {2, 2, 4})) << "two corners where the first vertex lies";
    EXPECT_EQ(dropped.degenerate, 1U);
    EXPECT_FALSE(isRepeated({7, 8, 3}, {0, 1, 4}));
    EXPECT_TRUE(isRepeated({7, 8, 3}, {0, 1, 4})) << "two corners apart in the source, at one point of the grid";
    EXPECT_EQ(dropped.collapsedByGrid, 1U);
    EXPECT_FALSE(isRepeated({7, 8, 3}, {1, 1, 4})) << "both elsewhere at a point: nobody knows whether together";
    EXPECT_FALSE(isRepeated({7, 8, 3}, {1, 1, 4}));
}

} // namespace
} // namespace gnomon::chunk
