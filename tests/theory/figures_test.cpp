// The figures' data and the table: the figures that the theory is recognised by.
#include "core/json_file.h"
#include "shadow/fit/overhead.h"
#include "shadow/partition/splits.h"
#include "shadow/scheme.h"
#include "theory/figures.h"
#include "theory/scheme_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gnomon::theory {
namespace {

const Figure& named(const std::vector<Figure>& figures, const std::string& start) {
    const auto found = std::find_if(
        figures.begin(), figures.end(), [&](const Figure& figure) { return figure.name.rfind(start, 0) == 0; });
    EXPECT_NE(found, figures.end()) << start;
    return *found;
}

TEST(TheoryFigures, AreCompleteAndFiniteWhereTheyShouldBe) {
    std::set<std::string> names;
    std::vector<Figure> all = paperFigures();
    EXPECT_EQ(all.size(), 7U);
    for (const Figure& figure : all) {
        EXPECT_TRUE(names.insert(figure.name).second);
        EXPECT_FALSE(figure.caption.empty());
        EXPECT_GE(figure.rows.size(), 20U);
        for (const std::vector<double>& row : figure.rows)
            ASSERT_EQ(row.size(), figure.columns.size()) << figure.name;
        for (const std::string& column : figure.columns)
            EXPECT_EQ(column.find(','), std::string::npos);
    }
}

TEST(TheoryFigures, HoldTheTheorysNumbers) {
    const std::vector<Figure> figures = paperFigures();
    const Figure& ten = named(figures, "figure10");
    EXPECT_NEAR(ten.rows[0][2], 1372, 1);
    EXPECT_NEAR(ten.rows[3][2], 25.4, 0.05);
    EXPECT_NEAR(ten.rows[7][2], 15.1, 0.05);
    EXPECT_NEAR(ten.rows[7][1], 35.7, 0.05);
    EXPECT_NEAR(ten.rows[0][3], 9.49, 0.01);
    const Figure& twelve = named(figures, "figure12");
    EXPECT_NEAR(twelve.rows[13][4], 37.6, 0.05); // the exact Eq 20 is least at k = 14
    EXPECT_LT(twelve.rows[13][4], twelve.rows[12][4]);
    EXPECT_LT(twelve.rows[13][4], twelve.rows[14][4]);
    EXPECT_EQ(csvOf(ten).substr(0, 21), "k,ZP,ZP+W,optimum\n1,1");
}

/// One number of a figure that hangs on its frustum alone, in the figure and from the frustum.
std::pair<double, double> tellingNumber(const Figure& figure, const shadow::ViewFrustum& frustum) {
    const std::string number = figure.name.substr(6, 2);
    const double lspsm = shadow::nPrimeLspsm(frustum);
    const double unwarped = std::numeric_limits<double>::infinity();
    const auto largest = [&](std::size_t column) {
        double value = 0;
        for (const std::vector<double>& row : figure.rows)
            if (std::isfinite(row[column])) value = std::max(value, row[column]);
        return value;
    };
    if (number == "02") return {largest(0), 1};           // two panels
    if (number == "04") return {largest(3), frustum.far}; // the map's end
    if (number == "05") return {figure.rows[0][3], shadow::aliasingOverhead(frustum, lspsm, frustum.near, {}).x};
    if (number == "06")
        return {
            figure.rows[100][3],
            shadow::storageFactorOverhead(frustum, lspsm) / shadow::storageFactorOverhead(frustum, unwarped)};
    const auto at = static_cast<std::size_t>(number == "10" ? 2 : 1);
    if (number == "10") return {figure.rows[4][at], shadow::closedForms(frustum, 5).zpWarpOverhead};
    if (number == "12") return {figure.rows[4][at], shadow::closedForms(frustum, 5).zpOverhead};
    shadow::Scheme scheme;
    scheme.warp.rule = shadow::WarpRule::None;
    scheme.slices = 1;
    const std::vector<double>& row = figure.rows[figure.rows.size() / 6]; // of the first panel
    const glm::dvec3 light(row[2], std::sqrt(std::max(0.0, 1 - row[1] * row[1] - row[2] * row[2])), row[1]);
    return {row[3], std::log10(shadow::storageFactor(shadow::schemeMaps(frustum, light, scheme)))};
}

TEST(TheoryFigures, AreDrawnForTheFrustaOfThePaper) {
    const std::vector<Figure> figures = paperFigures();
    const auto document = readJsonFile(GNOMON_SOURCE_DIR "/data/figures/lloyd2006.json");
    EXPECT_EQ(document["figures"].size(), figures.size());
    for (const auto& entry : document["figures"]) {
        const Figure& figure = named(figures, entry["figure"].get<std::string>());
        shadow::ViewFrustum frustum;
        frustum.near = entry["near"].get<double>();
        frustum.far = entry["far"].get<double>();
        frustum.halfFovYRadians = entry["theta"].get<double>() * 0.017453292519943295;
        const auto [drawn, expected] = tellingNumber(figure, frustum);
        EXPECT_NEAR(drawn, expected, 1e-9 * std::abs(expected)) << figure.name;
        EXPECT_NE(
            figure.caption.find("theta " + std::to_string(entry["theta"].get<int>()) + " degrees"), std::string::npos)
            << figure.caption;
    }
}

TEST(SlowTheoryFigures, OwnOnesHoldTheTheorysNumbers) {
    const std::vector<Figure> figures = ownFigures();
    EXPECT_EQ(figures.size(), 6U);
    const Figure& slices = named(figures, "own3");
    EXPECT_NEAR(slices.rows[3][3], 253, 2); // k = 4, minimax: worst and mean over all lights
    EXPECT_NEAR(slices.rows[3][4], 62, 2);
    EXPECT_NEAR(slices.rows[11][3], 75.9, 0.5); // more maps are not always better
    EXPECT_NEAR(slices.rows[19][3], 79.8, 0.5);
    const Figure& lambda = named(figures, "own4");
    EXPECT_NEAR(lambda.rows[100][2], 126, 1);
    EXPECT_NEAR(lambda.rows[95][2], 367, 1);
    EXPECT_NEAR(lambda.rows[50][2], 16440, 20);
    const Figure& logarithmic = named(figures, "own6");
    EXPECT_NEAR(logarithmic.rows[0][5], 2 * std::log(1000.0) + 1, 1e-6)
        << "light behind: four faces and the near square";
    for (const std::vector<double>& row : logarithmic.rows) {
        EXPECT_LE(row[5], 15.6);
        EXPECT_LE(row[5], row[1]);
    }
}

TEST(TheoryTable, HasEverySchemeForEveryK) {
    const std::vector<SchemeRow> table = schemeTable({1, 1000, 0.3490658503988659, 1}, {0, 1, 0});
    EXPECT_EQ(table.size(), 96U);
    for (const SchemeRow& row : table) {
        EXPECT_TRUE(std::isfinite(row.storageFactor) && row.storageFactor > 0);
        EXPECT_GE(row.maps, static_cast<std::size_t>(row.slices));
        const bool isFour = row.slices == 4;
        EXPECT_TRUE(!(isFour && row.warp == "auto*") || std::abs(row.storageFactor - 25.4) < 0.1);
        EXPECT_TRUE(row.warp != "log" || std::abs(row.storageFactor - 9.489) < 1e-3) << "however many maps";
        EXPECT_TRUE(!(isFour && row.scheme == "ZP stable") || std::abs(row.storageFactor - 253) < 1);
    }
}

} // namespace
} // namespace gnomon::theory
