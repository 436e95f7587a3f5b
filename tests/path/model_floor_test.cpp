// The floors of a model, its storeys, where most of them is, and the way over them.
#include "core/random.h"
#include "path/drawn_triangles.h"
#include "path/model_floor.h"
#include "path/storeys.h"
#include "path/way_search.h"
#include "tests/path/building.h"
#include "tests/path/made_model.h"

#include <gtest/gtest.h>

#include <set>

namespace gnomon::path {
namespace {

/// Storeys of 3 m with floors of 10 m by 10 m, as many as said, at a corner of a yard of 200 m.
struct House {
    int storeys = 3;
    glm::dvec3 corner{0};

    void operator()(const std::string& path) const {
        Boxes boxes;
        boxes.add({0, -0.2, 0}, {200, 0, 200});
        for (int storey = 0; storey < storeys; ++storey) {
            const double y = 3.0 * storey;
            if (storey > 0) boxes.add(corner + glm::dvec3(0, y - 0.2, 0), corner + glm::dvec3(10, y, 10));
            boxes.add(corner + glm::dvec3(0, y, 0), corner + glm::dvec3(10, y + 2.8, 0.2));
        }
        boxes.add(corner + glm::dvec3(0, 3.0 * storeys - 0.2, 0), corner + glm::dvec3(10, 3.0 * storeys, 10));
        boxes.write(path);
    }
};

TEST(DrawnTriangles, AreAllOfFullDetailWhereAllIsRefined) {
    const MadeModel model(made("statue", 20000));
    std::multiset<double> expected;
    for (const auto& t : model.triangles())
        expected.insert(t[0].x + 2 * t[1].y + 3 * t[2].z);
    std::multiset<double> found;
    const auto isRefined = [](double, const Sphere&) { return true; };
    forEachTriangle(
        model.file(), isRefined, [&](const TriangleCorners& t) { found.insert(t[0].x + 2 * t[1].y + 3 * t[2].z); });
    EXPECT_EQ(found, expected);
}

TEST(Storeys, AreTheFloorsUnderCeilingsFromBelow) {
    for (int storeys = 1; storeys <= 4; ++storeys) {
        const MadeModel model(House{storeys, {80, 0, 80}});
        const Box region{{75, -1, 75}, {95, 20, 95}};
        const WalkableFloor floor = floorOf(model.file(), region, {}, fineCell({}));
        const std::vector<Storey> found = findStoreys(floor);
        ASSERT_EQ(found.size(), static_cast<std::size_t>(storeys)) << listOf(found);
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_NEAR(found[i].height, 3.0 * static_cast<double>(i), 0.03);
            EXPECT_NEAR(found[i].area, 100, 20);
            for (std::size_t other = 0; other < found.size(); ++other)
                EXPECT_EQ(bandOf(found, i, {}).holds(found[other].height), other == i);
        }
    }
}

TEST(BestRegions, HoldTheHouseInTheYard) {
    Random random(9);
    for (int trial = 0; trial < 4; ++trial) {
        const glm::dvec3 corner{random.uniform(5, 185), 0, random.uniform(5, 185)};
        const MadeModel model(House{3, corner});
        const WalkableFloor coarse = floorOf(model.file(), model.file().summary().bounds, {}, 0.4);
        const std::vector<Box> regions = bestRegions(coarse, {}, 40, 3);
        ASSERT_EQ(regions.size(), 3U);
        EXPECT_LE(regions[0].min.x, corner.x + 0.5);
        EXPECT_LE(regions[0].min.z, corner.z + 0.5);
        EXPECT_GE(regions[0].max.x, corner.x + 9.5);
        EXPECT_GE(regions[0].max.z, corner.z + 9.5);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const glm::dvec3 apart = glm::abs(regions[i].center() - regions[j].center());
                EXPECT_GE(std::max(apart.x, apart.z), 39.5) << "no two over each other";
            }
    }
}

TEST(Ways, GoFromCellToCellAndNoFartherThanTheyMay) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const MadeModel model(Building(seed, 3, 3));
        const WalkableFloor floor = floorOf(model.file(), model.file().summary().bounds, {}, fineCell({}));
        for (const double longest : {4.0, 12.0, 84.0}) {
            const auto way = findWay(floor, {-1, 1, longest});
            ASSERT_TRUE(way);
            EXPECT_LE(way->length, longest);
            EXPECT_GT(way->length, std::min(0.9 * longest, 12.0));
            double length = 0;
            for (std::size_t i = 0; i < way->cells.size(); ++i) {
                EXPECT_TRUE(floor.isWalkable(way->cells[i]));
                if (i == 0) continue;
                const glm::dvec3 step = floor.position(way->cells[i]) - floor.position(way->cells[i - 1]);
                EXPECT_LE(std::max(std::abs(step.x), std::abs(step.z)), 1.001 * floor.grid().cell);
                EXPECT_LE(std::abs(step.y), floor.body().step);
                length += std::hypot(step.x, step.z);
            }
            EXPECT_NEAR(way->length, length, 1e-3 * length);
        }
    }
}

} // namespace
} // namespace gnomon::path
