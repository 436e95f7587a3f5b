// The golden rows: 269 candidates of an independent double-precision reference, each within its own tolerance. What
// they expect is written as the doubles nearest to what 200 bits give, which a twin finds anew.
#include "core/error.h"
#include "core/file.h"
#include "tests/theory/exact_rows.h"
#include "theory/rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

namespace gnomon::theory {
namespace {

using nlohmann::json;

const std::string kRows = GNOMON_SOURCE_DIR "/tests/theory/golden_public.json";

/// The largest deviation of `got` from `expected` in units of `rtol`, over everything that `expected` names.
double deviation(const json& expected, const json& got, double rtol) {
    if (expected.is_object()) {
        double worst = 0;
        for (const auto& [key, value] : expected.items()) {
            if (!got.contains(key)) return INFINITY;
            worst = std::max(worst, deviation(value, got[key], rtol));
        }
        return worst;
    }
    if (expected.is_array()) {
        if (!got.is_array() || got.size() != expected.size()) return INFINITY;
        double worst = 0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            worst = std::max(worst, deviation(expected[i], got[i], rtol));
        return worst;
    }
    if (!expected.is_number()) return expected == got ? 0 : INFINITY;
    if (!got.is_number()) return INFINITY;
    const double want = expected.get<double>();
    const double difference = std::abs(got.get<double>() - want);
    // A zero has no relative error; 1e-12 of a unit frustum is rounding.
    return difference <= 1e-12 ? 0 : difference / (rtol * std::abs(want));
}

/// As `deviation`, but s may be mirrored where the row says so.
double deviationOfRow(const json& row, const json& got) {
    const double rtol = row["rtol"].get<double>();
    const double plain = deviation(row["expect"], got, rtol);
    if (row["family"] != "point_map") return plain;
    json mirrored = got;
    mirrored["s"] = 1 - got["s"].get<double>();
    return std::min(plain, deviation(row["expect"], mirrored, rtol));
}

TEST(Golden, EveryRowIsWithinItsTolerance) {
    const json document = json::parse(readTextFile(kRows));
    ASSERT_EQ(document["rows"].size(), 269U);
    const json candidates = evaluateRows(document, kRows)["rows"];
    ASSERT_EQ(candidates.size(), 269U);
    double worst = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const json& row = document["rows"][i];
        ASSERT_EQ(candidates[i]["id"], row["id"]);
        const double found = deviationOfRow(row, candidates[i]["got"]);
        EXPECT_LE(found, 1.0) << row.dump() << "\n" << candidates[i].dump();
        worst = std::max(worst, found);
    }
    RecordProperty("worst_in_tolerances", std::to_string(worst));
}

TEST(Golden, EveryExpectedNumberIsCorrectlyRounded) {
    const json document = json::parse(readTextFile(kRows));
    for (const json& row : document["rows"]) {
        const json exact = exactRow(row);
        for (const auto& [key, value] : row["expect"].items())
            EXPECT_EQ(exact.at(key), value) << row["id"] << ": " << key;
    }
}

TEST(Golden, RowsNeedNeitherExpectationNorId) {
    const json document = {{"rows", {{{"family", "eq15_eq16_planes"}, {"inputs", {{"n", 1}, {"f", 100}, {"k", 2}}}}}}};
    const json candidates = evaluateRows(document, "rows.json");
    EXPECT_NEAR(candidates["rows"][0]["got"]["planes"][1].get<double>(), 10.0, 1e-12);
}

TEST(Golden, BadRowsAreNamed) {
    const auto refused = [](const json& row) {
        try {
            evaluateRows({{"rows", {row}}}, "rows.json");
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    const json inputs = {{"n", 1}, {"f", 100}, {"k", 2}};
    EXPECT_NE(refused({{"family", "eq99"}, {"inputs", inputs}}).find("rows.json: row 0"), std::string::npos);
    EXPECT_NE(refused({{"inputs", inputs}}).find("family"), std::string::npos);
    EXPECT_NE(refused({{"family", "eq15_eq16_planes"}, {"inputs", {{"n", 1}}}}).find("input"), std::string::npos);
    EXPECT_NE(
        refused({{"family", "eq15_eq16_planes"}, {"inputs", {{"n", 1}, {"f", "x"}, {"k", 2}}}}).find("number"),
        std::string::npos);
}

} // namespace
} // namespace gnomon::theory
