// The table of schemes against sums of the theory's own rows and against what more maps, faces and turns must bring;
// the lights that figures are sampled at; the text of a figure.
#include "core/random.h"
#include "theory/embedded_files.h"
#include "theory/figures.h"
#include "theory/rows.h"
#include "theory/sampling.h"
#include "theory/scheme_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include <nlohmann/json.hpp>

namespace gnomon::theory {
namespace {

using nlohmann::json;

shadow::ViewFrustum anyFrustum(Random& random) {
    const double near = std::pow(10, random.uniform(-2, 1));
    const double far = near * std::pow(10, random.uniform(0.3, 4));
    return {near, far, random.uniform(0.1, 0.7), random.uniform(0.6, 2)};
}

glm::dvec3 anyLight(Random& random) {
    const std::vector<glm::dvec3> lights = evenHemisphere(400);
    return lights[random.below(lights.size())];
}

json inputsOf(const shadow::ViewFrustum& frustum, const glm::dvec3& light, const SchemeRow& row) {
    return {
        {"n", frustum.near},
        {"f", frustum.far},
        {"theta_rad", frustum.halfFovYRadians},
        {"aspect", frustum.aspect},
        {"L", {light.x, light.y, light.z}},
        {"k", row.slices},
        {"policy", row.warp}};
}

// `theory eval` is held to the golden rows, so what it says of a scheme is an answer of its own.
TEST(SchemeTable, SumsUpWhatTheRowsSayOfEveryScheme) {
    Random random(1);
    for (int trial = 0; trial < 12; ++trial) {
        const shadow::ViewFrustum frustum = anyFrustum(random);
        const glm::dvec3 light = anyLight(random);
        int compared = 0;
        for (const SchemeRow& row : schemeTable(frustum, light)) {
            if (row.scheme == "ZP stable" || row.warp == "auto*" || row.scheme.starts_with("FP")) continue;
            const json asked = {{"rows", {{{"family", "scheme_zp"}, {"inputs", inputsOf(frustum, light, row)}}}}};
            const json got = evaluateRows(asked, "table")["rows"][0]["got"];
            EXPECT_EQ(got["maps"], row.maps);
            double sum = 0;
            for (const json& slice : got["S_per_slice"])
                sum += slice.get<double>();
            EXPECT_NEAR(row.storageFactor, sum, 1e-9 * sum) << row.scheme << " " << row.warp << " " << row.slices;
            ++compared;
        }
        EXPECT_EQ(compared, 48);
    }
}

TEST(SchemeTable, HasEachSchemeOfEachNumberOfSlicesOnceAndInOrder) {
    Random random(2);
    std::map<std::pair<std::string, std::string>, int> last;
    for (const SchemeRow& row : schemeTable(anyFrustum(random), anyLight(random))) {
        int& slices = last[{row.scheme, row.warp}];
        EXPECT_EQ(row.slices, slices + 1) << row.scheme;
        slices = row.slices;
    }
    EXPECT_EQ(last.size(), 12U);
    for (const auto& [scheme, slices] : last)
        EXPECT_EQ(slices, 8) << scheme.first << " " << scheme.second;
}

TEST(SchemeTable, HasAMapForEachSliceAndUpToFiveWithFaces) {
    Random random(3);
    for (int trial = 0; trial < 10; ++trial)
        for (const SchemeRow& row : schemeTable(anyFrustum(random), anyLight(random))) {
            const auto slices = static_cast<std::size_t>(row.slices);
            const bool hasFaces = row.scheme.starts_with("FP");
            EXPECT_GE(row.maps, slices);
            EXPECT_LE(row.maps, hasFaces ? 5 * slices : slices) << row.scheme;
            const double product = row.worstX * row.worstZ;
            EXPECT_LE(row.storageFactor, static_cast<double>(row.maps) * product * (1 + 1e-9)) << row.scheme;
            if (row.maps == 1) {
                EXPECT_NEAR(row.storageFactor, product, 1e-9 * product) << row.scheme;
            }
        }
}

/// The storage factor of a scheme by its name, its warp and its number of slices.
std::map<std::string, double> factors(const shadow::ViewFrustum& frustum, const glm::dvec3& light) {
    std::map<std::string, double> all;
    for (const SchemeRow& row : schemeTable(frustum, light))
        all[row.scheme + " " + row.warp + " " + std::to_string(row.slices)] = row.storageFactor;
    return all;
}

TEST(SchemeTable, WarpsOfTheirOwnAccordNeverMoreThanNoneDo) {
    Random random(4);
    for (int trial = 0; trial < 30; ++trial) {
        const auto factor = factors(anyFrustum(random), anyLight(random));
        for (int k = 1; k <= 8; ++k) {
            const std::string slices = std::to_string(k);
            EXPECT_LE(factor.at("ZP+W auto " + slices), factor.at("ZP none " + slices) * (1 + 1e-9)) << k;
            EXPECT_LE(factor.at("ZP none " + slices), factor.at("ZP stable none " + slices) * (1 + 1e-9))
                << "a ball around a slice is larger than what is fitted to it";
        }
    }
}

TEST(SchemeTable, HangsOnRatiosOfDepthsAlone) {
    Random random(5);
    for (int trial = 0; trial < 10; ++trial) {
        shadow::ViewFrustum frustum = anyFrustum(random);
        const glm::dvec3 light = anyLight(random);
        const auto before = factors(frustum, light);
        frustum.near *= 1000;
        frustum.far *= 1000;
        for (const auto& [scheme, factor] : factors(frustum, light))
            EXPECT_NEAR(factor, before.at(scheme), 1e-6 * factor) << scheme;
    }
}

TEST(SchemeTable, IsTheSameForALightFromTheOtherSide) {
    Random random(6);
    for (int trial = 0; trial < 10; ++trial) {
        const shadow::ViewFrustum frustum = anyFrustum(random);
        const glm::dvec3 light = anyLight(random);
        const auto before = factors(frustum, light);
        for (const auto& [scheme, factor] : factors(frustum, {-light.x, light.y, light.z})) {
            if (scheme.find("auto*") != std::string::npos) continue; // its turn is found by steps
            EXPECT_NEAR(factor, before.at(scheme), 1e-6 * factor) << scheme;
        }
    }
}

TEST(Sampling, TheGridCoversTheDiscOnceAndEvenly) {
    const std::vector<glm::dvec3> lights = hemisphereGrid();
    std::map<std::pair<long, long>, int> cells;
    for (const glm::dvec3& light : lights) {
        EXPECT_NEAR(glm::length(light), 1, 1e-12);
        EXPECT_GE(light.y, 0);
        EXPECT_NEAR(light.x * 30, std::round(light.x * 30), 1e-9);
        ++cells[{std::lround(light.x * 30), std::lround(light.z * 30)}];
    }
    int inDisc = 0;
    for (int i = -30; i <= 30; ++i)
        for (int j = -30; j <= 30; ++j)
            inDisc += i * i + j * j <= 900 ? 1 : 0;
    EXPECT_NEAR(static_cast<double>(lights.size()), inDisc, 12) << "but for rounding on the rim";
    for (const auto& [cell, count] : cells)
        EXPECT_EQ(count, 1);
    EXPECT_TRUE(cells.contains({0, 0}) && cells.contains({0, -29}) && cells.contains({29, 0}));
}

TEST(Sampling, AnEvenHemisphereHasAsManyInEveryCap) {
    for (const int count : {1, 10, 1500}) {
        const std::vector<glm::dvec3> lights = evenHemisphere(count);
        ASSERT_EQ(lights.size(), static_cast<std::size_t>(count));
        glm::dvec3 sum(0);
        for (const glm::dvec3& light : lights) {
            EXPECT_NEAR(glm::length(light), 1, 1e-12);
            EXPECT_GT(light.y, 0);
            sum += light;
        }
        EXPECT_NEAR(sum.y / count, 0.5, 1e-12) << "the mean height of a hemisphere";
    }
    Random random(7);
    const std::vector<glm::dvec3> lights = evenHemisphere(4000);
    for (int trial = 0; trial < 20; ++trial) { // caps that lie wholly above the horizon
        const double cosine = random.uniform(0.8, 0.95);
        const double height = random.uniform(0.65, 1);
        const double angle = random.uniform(0, 6.28);
        const double radius = std::sqrt(1 - height * height);
        const glm::dvec3 middle(radius * std::cos(angle), height, radius * std::sin(angle));
        int inside = 0;
        for (const glm::dvec3& light : lights)
            inside += glm::dot(light, middle) >= cosine ? 1 : 0;
        EXPECT_NEAR(inside, 4000 * (1 - cosine), 30) << "the part of the area that a cap has";
    }
}

TEST(FigureCsv, HasACellForEachColumnAndNothingForNoNumber) {
    Random random(8);
    Figure figure;
    figure.columns = {"x", "one", "two"};
    for (int i = 0; i < 200; ++i) {
        figure.rows.push_back({static_cast<double>(i), random.uniform(-1, 1) * std::pow(10, random.uniform(-9, 9)), 0});
        if (random.below(3) == 0) figure.rows.back()[2] = std::numeric_limits<double>::quiet_NaN();
    }
    std::istringstream lines(csvOf(figure));
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(line, "x,one,two");
    for (const std::vector<double>& row : figure.rows) {
        ASSERT_TRUE(std::getline(lines, line));
        std::istringstream cells(line + ",");
        for (const double value : row) {
            std::string cell;
            ASSERT_TRUE(std::getline(cells, cell, ',')) << line;
            EXPECT_EQ(cell.empty(), std::isnan(value)) << line;
            if (!cell.empty()) {
                EXPECT_NEAR(std::stod(cell), value, 1e-9 * std::abs(value));
            }
        }
    }
    EXPECT_FALSE(std::getline(lines, line));
    EXPECT_EQ(csvOf(Figure()), "\n");
}

TEST(FigureScript, ReadsTheFilesThatTheCommandWrites) {
    const std::string script(kFiguresScript);
    for (const char* word : {"figures.json", "\"columns\"", "log_x", "\"panels\"", "\"caption\"", "def main"})
        EXPECT_NE(script.find(word), std::string::npos) << word;
    EXPECT_TRUE(script.ends_with("main()\n")) << "it is there to its end";
}

} // namespace
} // namespace gnomon::theory
