// Figures of points on a grid: against whole numbers, wherever they lie and however they are turned.
#include "core/random.h"
#include "inspect/cells.h"
#include "inspect/figures.h"
#include "inspect/measures.h"

#include <gtest/gtest.h>

#include <sstream>

#include <nlohmann/json.hpp>

namespace gnomon::inspect {
namespace {

constexpr double kStep = 0x1p-10;
constexpr glm::dvec3 kUp(0, 0, 1);

std::vector<glm::i64vec3> randomCells(Random& random, int count, double reach) {
    std::vector<glm::i64vec3> cells;
    cells.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        cells.emplace_back(
            std::llround(random.uniform(-reach, reach)),
            std::llround(random.uniform(-reach, reach)),
            std::llround(random.uniform(-reach, reach)));
    return cells;
}

std::vector<double> all(const Figures& figures) {
    std::vector<double> values = {
        figures.along,
        figures.straight,
        figures.height,
        figures.level,
        figures.slopeDegrees,
        figures.perimeter,
        figures.area,
        figures.planArea};
    values.insert(values.end(), figures.legs.begin(), figures.legs.end());
    for (const std::optional<double>& angle : figures.anglesDegrees)
        values.push_back(angle.value_or(-1));
    return values;
}

TEST(SurveyFigures, AreThoseOfWholeNumbers) {
    Random random(1);
    for (int round = 0; round < 500; ++round) {
        const auto cells = randomCells(random, 5, 1 << 20);
        const Figures figures = figuresOf(cells, kStep, kUp);
        ASSERT_EQ(figures.legs.size(), 4U);
        double along = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::i64vec3 leg = cells[i + 1] - cells[i];
            const std::int64_t square = leg.x * leg.x + leg.y * leg.y + leg.z * leg.z;
            ASSERT_EQ(figures.legs[i], std::sqrt(static_cast<double>(square)) * kStep);
            along += figures.legs[i];
        }
        ASSERT_EQ(figures.along, along);
        const glm::i64vec3 whole = cells[4] - cells[0];
        ASSERT_EQ(figures.height, static_cast<double>(whole.z) * kStep);
        ASSERT_DOUBLE_EQ(figures.level, std::hypot(double(whole.x), double(whole.y)) * kStep);
        ASSERT_NEAR(std::tan(figures.slopeDegrees / 57.29577951308232), figures.height / figures.level, 1e-9 * along);
        // The law of cosines, and Heron's formula for the area of the first three.
        const Figures three = figuresOf(std::span(cells).first(3), kStep, kUp);
        const double a = three.legs[0], b = three.legs[1], c = three.straight;
        const double half = (a + b + c) / 2;
        ASSERT_NEAR(three.area, std::sqrt(half * (half - a) * (half - b) * (half - c)), 1e-6 * a * b);
        ASSERT_NEAR(std::cos(*three.anglesDegrees[0] / 57.29577951308232), (a * a + b * b - c * c) / (2 * a * b), 1e-9);
        ASSERT_DOUBLE_EQ(three.perimeter, a + b + c);
        ASSERT_LT(three.offPlane, 1e-6 * a);
    }
}

TEST(SurveyFigures, DependNeitherOnThePlaceNorOnTheOrderOfTheAxes) {
    Random random(2);
    for (int round = 0; round < 500; ++round) {
        const auto cells = randomCells(random, 6, 1LL << 31);
        const glm::i64vec3 far = randomCells(random, 1, 1LL << 50)[0];
        std::vector<glm::i64vec3> moved, turned;
        for (const glm::i64vec3& cell : cells) {
            moved.push_back(cell + far);
            turned.emplace_back(cell.y, cell.z, cell.x);
        }
        const std::vector<double> expected = all(figuresOf(cells, kStep, kUp));
        ASSERT_EQ(all(figuresOf(moved, kStep, kUp)), expected);
        const std::vector<double> values = all(figuresOf(turned, kStep, {0, 5, 0}));
        for (std::size_t i = 0; i < expected.size(); ++i)
            ASSERT_NEAR(values[i], expected[i], 1e-14 * std::abs(expected[i])) << i;
    }
}

/// Twice the area that a polygon of a plane z = x + 2 y encloses, seen along z: the sum of whole trapezoids.
std::int64_t twiceEnclosed(const std::vector<glm::i64vec3>& cells) {
    std::int64_t twice = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const glm::i64vec3& a = cells[i];
        const glm::i64vec3& b = cells[(i + 1) % cells.size()];
        twice += (b.x - a.x) * (b.y + a.y);
    }
    return std::abs(twice);
}

TEST(SurveyFigures, AreasOfConcavePolygonsOnSlopesAreExact) {
    Random random(3);
    for (int round = 0; round < 500; ++round) {
        std::vector<glm::i64vec3> star; // about the origin, so that it does not meet itself
        for (int i = 0; i < 11; ++i) {
            const double angle = 0.571 * i, reach = random.uniform(1000, 1e6);
            const glm::i64vec3 cell(std::llround(reach * std::cos(angle)), std::llround(reach * std::sin(angle)), 0);
            star.emplace_back(cell.x, cell.y, cell.x + 2 * cell.y);
        }
        const Figures figures = figuresOf(star, kStep, kUp);
        const double plan = static_cast<double>(twiceEnclosed(star)) / 2 * kStep * kStep;
        ASSERT_EQ(figures.planArea, plan);
        ASSERT_DOUBLE_EQ(figures.area, plan * std::sqrt(6.0)); // a plane whose normal is (1, 2, -1)
        ASSERT_LT(figures.offPlane, 1e-6);
    }
}

TEST(SurveyFigures, OfFewPointsAreEmptyAndOfOnePlaceAreNoAngles) {
    const glm::i64vec3 a(1, 2, 3);
    EXPECT_TRUE(figuresOf(std::vector<glm::i64vec3>{}, kStep, kUp).legs.empty());
    EXPECT_TRUE(figuresOf(std::vector{a}, kStep, kUp).legs.empty());
    const Figures same = figuresOf(std::vector{a, a, a}, kStep, kUp);
    EXPECT_EQ(same.straight, 0);
    EXPECT_EQ(same.area, 0);
    EXPECT_EQ(same.offPlane, 0);
    EXPECT_FALSE(same.anglesDegrees[0]);
    const Figures straight = figuresOf(std::vector{a, 2L * a, 3L * a}, kStep, kUp);
    EXPECT_EQ(straight.anglesDegrees[0], 180);
    const Figures bent = figuresOf(
        std::vector{glm::i64vec3(0, 0, 4), glm::i64vec3(0, 0, 0), glm::i64vec3(7, 0, 0), glm::i64vec3(7, 3, 9)},
        1,
        {0, 0, 2});
    EXPECT_EQ(bent.anglesDegrees[0], 90);
    EXPECT_GT(bent.offPlane, 0.4);
}

/// A grid as surveys have it: the origin in UTM coordinates, its steps about a hundredth of a millimetre.
Surveyed survey() {
    Surveyed of;
    of.model = "site.gnm";
    of.grid = {{499987.25, 5200012.5, 96.0625}, -17};
    of.up = {0, 0, 1};
    return of;
}

TEST(SurveyCells, AreTheNearestWhereverTheGridLies) {
    Random random(4);
    const hierarchy::Grid grid = survey().grid;
    for (int round = 0; round < 1000; ++round) {
        const glm::i64vec3 cell = randomCells(random, 1, 1LL << 31)[0];
        const glm::dvec3 world = worldOf(grid, cell);
        const glm::dvec3 off(random.uniform(-0.49, 0.49), random.uniform(-0.49, 0.49), random.uniform(-0.49, 0.49));
        ASSERT_EQ(cellOf(grid, world), cell);
        ASSERT_EQ(cellOf(grid, world + off * grid.step()), cell);
    }
}

TEST(SurveyMeasures, ReadBackAsTheyAreFromJsonAndCsv) {
    const Surveyed of = survey();
    const std::vector<Measure> measures = {
        {{{0, 0, 0}, 0.5}, {{1 << 17, 0, 0}, 0.25}, {{1 << 17, 3 << 17, 0}, 0}}, {{{7, 8, 9}, 1e-3}}};
    const auto json = nlohmann::json::parse(jsonOf(measures, of));
    EXPECT_EQ(json["unit"], "m");
    EXPECT_EQ(json["grid_step"], 0x1p-17);
    ASSERT_EQ(json["measures"].size(), 2U);
    const auto& first = json["measures"][0];
    EXPECT_EQ(first["points"][2]["position"], nlohmann::json({499988.25, 5200015.5, 96.0625}));
    EXPECT_EQ(first["points"][1]["within"], 0.25);
    EXPECT_EQ(first["legs"], nlohmann::json({1.0, 3.0}));
    EXPECT_EQ(first["area"], 1.5);
    EXPECT_EQ(first["plan_area"], 1.5);
    EXPECT_EQ(first["angles_degrees"], nlohmann::json({90.0}));
    EXPECT_FALSE(json["measures"][1].contains("area"));
    std::istringstream csv(csvOf(measures, of));
    std::vector<std::string> rows;
    for (std::string row; std::getline(csv, row);)
        rows.push_back(row);
    ASSERT_EQ(rows.size(), 5U);
    EXPECT_EQ(rows[1], "1,1,499987.25,5200012.5,96.0625,0.5,,,,,,,,,,,");
    EXPECT_EQ(rows[2], "1,2,499988.25,5200012.5,96.0625,0.25,1,1,1,0,1,0,,,,,");
    EXPECT_EQ(rows[3].substr(0, 40), "1,3,499988.25,5200015.5,96.0625,0,3,4,3.");
    EXPECT_EQ(rows[4].substr(0, 4), "2,1,");
    for (const std::string& row : rows)
        EXPECT_EQ(std::count(row.begin(), row.end(), ','), 16) << row;
}

TEST(SurveyMeasures, AreToldWithTheDigitsOfTheGrid) {
    Measure measure = {{{0, 0, 0}, 0.001}, {{1 << 17, 0, 0}, 0.002}, {{1 << 17, 3 << 17, 0}, 0}};
    const std::vector<std::string> lines = inWords(measure, survey());
    ASSERT_EQ(lines.size(), 6U);
    EXPECT_EQ(lines[0], "point 3: 499988.250000, 5200015.500000, 96.062500, within 0.000000 m");
    EXPECT_EQ(lines[1], "straight 3.162278 m, within 0.001000 m");
    EXPECT_EQ(lines[4], "angle 90.0000 degrees at point 2");
    measure.resize(1);
    EXPECT_EQ(inWords(measure, survey()).size(), 1U);
    EXPECT_TRUE(inWords({}, survey()).empty());
}

} // namespace
} // namespace gnomon::inspect
