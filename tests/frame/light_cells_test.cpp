// Where triangles and boxes lie over the cells, held against points of them.
#include "core/random.h"
#include "frame/light_cells.h"

#include <gtest/gtest.h>

namespace gnomon::frame {
namespace {

bool holds(const exact::CellBox& box, const glm::dvec2& p) {
    return p.x >= box.x0 && p.x <= box.x1 + 1 && p.y >= box.y0 && p.y <= box.y1 + 1;
}

TEST(LightCells, HoldEveryPointOfATriangleThatIsNotCutOff) {
    constexpr double kLeastW = 0.5;
    Random random(1);
    int inside = 0;
    for (int i = 0; i < 2000; ++i) {
        std::array<glm::dvec3, 3> places{};
        for (glm::dvec3& p : places) {
            const double w = random.uniform(-0.2, 2);
            p = {random.uniform(-50, 300) * w, random.uniform(-50, 300) * w, w};
        }
        const exact::CellBox box = cellsOf(places, kLeastW);
        for (int k = 0; k < 20; ++k) {
            const double a = random.uniform(0, 1);
            const double b = random.uniform(0, 1 - a);
            const glm::dvec3 p = a * places[0] + b * places[1] + (1 - a - b) * places[2];
            const glm::dvec2 cell(p.x / p.z, p.y / p.z);
            if (p.z < kLeastW || cell.x < 0 || cell.y < 0 || cell.x > 256 || cell.y > 256) continue;
            ++inside;
            EXPECT_TRUE(holds(box, cell));
        }
    }
    EXPECT_GT(inside, 5000);
}

TEST(LightCells, RowsOfATriangleHoldItAndLittleElse) {
    const std::array<glm::dvec2, 3> p{glm::dvec2(10, 10), glm::dvec2(90, 20), glm::dvec2(20, 80)};
    const std::array<glm::dvec3, 3> places{glm::dvec3(p[0], 1), glm::dvec3(p[1], 1), glm::dvec3(p[2], 1)};
    const exact::CellBox box = cellsOf(places, 0.5);
    double cells = 0;
    for (int row = box.y0; row <= box.y1; ++row) {
        const exact::CellBox span = rowSpan(p, box, row);
        if (!span.empty()) cells += span.x1 - span.x0 + 1;
    }
    const double area = coveredArea(places, 0.5, box);
    EXPECT_NEAR(area, 0.5 * (80 * 70 - 10 * 10), 1e-9);
    EXPECT_GT(cells, area);
    EXPECT_LT(cells, 1.15 * area);
    EXPECT_EQ(coveredArea(places, 2, box), (box.x1 - box.x0 + 1.0) * (box.y1 - box.y0 + 1.0)) << "cut off";
}

TEST(LightCells, HoldTheCornersOfABoxAndItsGreatestHeight) {
    Random random(2);
    for (int i = 0; i < 300; ++i) {
        const exact::LightShear shear =
            exact::shearAlong(roundedLight({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}));
        const glm::dmat3 cells(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(128, 128, 1));
        const glm::dvec3 least(random.uniform(-20, 0), random.uniform(-20, 0), random.uniform(-20, 0));
        const glm::dvec3 most = least + glm::dvec3(random.uniform(0, 20), random.uniform(0, 20), random.uniform(0, 20));
        const LightBox box = lightBox(shear, cells, 0.5, least, most);
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec3 p = least;
            for (int axis = 0; axis < 3; ++axis)
                if ((corner >> axis & 1) != 0) p[axis] = most[axis];
            const glm::dvec3 at = sheared(shear, p);
            EXPECT_TRUE(holds(box.cells, glm::dvec2(at) + 128.0));
            EXPECT_LE(static_cast<float>(at.z), box.highest);
        }
    }
}

} // namespace
} // namespace gnomon::frame
