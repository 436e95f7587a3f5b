// The rows of `gnomon theory eval`: every family misses each of its inputs by name, and answers keep their row's shape.
#include "core/error.h"
#include "core/file.h"
#include "theory/rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

namespace gnomon::theory {
namespace {

using nlohmann::json;

/// The first golden row of each family.
const std::map<std::string, json>& families() {
    static const std::map<std::string, json> all = [] {
        std::map<std::string, json> first;
        const json document = json::parse(readTextFile(GNOMON_SOURCE_DIR "/tests/theory/golden_public.json"));
        for (const json& row : document["rows"])
            first.emplace(row["family"].get<std::string>(), row);
        return first;
    }();
    return all;
}

json answerOf(const std::string& family, const json& inputs) {
    return evaluateRows({{"rows", {{{"family", family}, {"inputs", inputs}}}}}, "rows.json")["rows"][0]["got"];
}

/// What is said against a row; empty if it is answered.
std::string refusal(const std::string& family, const json& inputs) {
    try {
        answerOf(family, inputs);
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

/// Inputs that a family can do without: a frustum's angle and aspect have usual values, and faces are asked for by
/// naming their bisector.
const std::set<std::string> kOptional = {"theta_rad", "aspect", "bisector"};

/// The inputs of the first row of `family` that it cannot do without.
std::vector<std::string> neededInputs(const std::string& family) {
    std::vector<std::string> needed;
    const json& inputs = families().at(family)["inputs"];
    for (const auto& [key, value] : inputs.items()) {
        json without = inputs;
        without.erase(key);
        if (!refusal(family, without).empty()) needed.push_back(key);
    }
    return needed;
}

TEST(RowErrors, FourteenFamiliesAreKnown) {
    EXPECT_EQ(families().size(), 14U);
}

TEST(RowErrors, AMissingInputIsNamedWithItsRow) {
    for (const auto& [family, row] : families()) {
        const std::vector<std::string> needed = neededInputs(family);
        EXPECT_GE(needed.size(), 2U) << family;
        for (const std::string& key : needed) {
            json inputs = row["inputs"];
            inputs.erase(key);
            EXPECT_EQ(
                refusal(family, inputs),
                "rows.json: row 0: input " + key + " is missing: expected a value, found nothing")
                << family;
        }
        json inputs = row["inputs"];
        for (const auto& [key, value] : row["inputs"].items())
            if (kOptional.contains(key)) inputs.erase(key);
        EXPECT_EQ(refusal(family, inputs), "") << family;
    }
}

TEST(RowErrors, AnInputOfAnotherTypeIsShown) {
    for (const auto& [family, row] : families())
        for (const std::string& key : neededInputs(family))
            for (const json& wrong : {json(nullptr), json::object(), json(true), json::array({1, 2})}) {
                json inputs = row["inputs"];
                inputs[key] = wrong;
                const std::string message = refusal(family, inputs);
                EXPECT_TRUE(message.starts_with("rows.json: row 0: input " + key + ": expected ")) << family << message;
                EXPECT_TRUE(message.ends_with("found " + wrong.dump())) << family << message;
            }
}

TEST(RowErrors, ACountIsWholeAndNotWithoutEnd) {
    for (const auto& [family, row] : families()) {
        if (!row["inputs"].contains("k")) continue;
        for (const json& wrong : {json(0), json(-1), json(2.5), json(4097), json(1e300), json("inf")}) {
            json inputs = row["inputs"];
            inputs["k"] = wrong;
            EXPECT_EQ(
                refusal(family, inputs),
                "rows.json: row 0: input k: expected a whole number from 1 to 4096, found " + wrong.dump());
        }
        json inputs = row["inputs"];
        inputs["k"] = 3;
        EXPECT_EQ(refusal(family, inputs), "") << family;
    }
}

TEST(RowErrors, AFrustumThatIsNoneIsRefusedWhereverItIsAsked) {
    for (const auto& [family, row] : families()) {
        if (family == "eq15_eq16_planes") continue; // two depths, of which it makes no frustum
        for (const auto& [near, far] : std::vector<std::pair<double, double>>{{0, 1}, {-1, 1}, {2, 1}, {1, 1}}) {
            json inputs = row["inputs"];
            inputs["n"] = near;
            inputs["f"] = far;
            EXPECT_TRUE(refusal(family, inputs).starts_with("rows.json: row 0: ")) << family << near << " " << far;
        }
        json inputs = row["inputs"];
        inputs["theta_rad"] = 1.6; // of half the angle: more than all around
        EXPECT_NE(refusal(family, inputs), "") << family;
    }
}

TEST(RowErrors, ALightHasADirection) {
    for (const auto& [family, row] : families()) {
        if (!row["inputs"].contains("L")) continue;
        for (const json& wrong :
             {json({0, 0, 0}), json({1, 2}), json({1, 2, 3, 4}), json({1, "2", 3}), json({1e308, 1e308, 1e308})}) {
            json inputs = row["inputs"];
            inputs["L"] = wrong;
            EXPECT_TRUE(refusal(family, inputs).starts_with("rows.json: row 0: input L")) << family << wrong;
        }
        json longer = row["inputs"];
        json before = answerOf(family, longer);
        for (json& part : longer["L"])
            part = part.get<double>() * 4; // a power of two, so that no bit differs
        EXPECT_EQ(answerOf(family, longer), before) << family << ": a light has no length";
    }
}

TEST(RowErrors, APolicyIsAWarpRuleUnderAnyOfItsNames) {
    json inputs = families().at("general_frustum")["inputs"];
    inputs["policy"] = "best";
    EXPECT_EQ(
        refusal("general_frustum", inputs),
        "rows.json: row 0: unknown policy: expected minmz, minimax, ortho, none, w04, lspsm, sopt, auto, psm, tsm, "
        "eta, given or log, found best");
    for (const auto& [one, other] :
         std::map<std::string, std::string>{{"minmz", "minimax"}, {"ortho", "none"}, {"w04", "lspsm"}}) {
        inputs["policy"] = one;
        const json first = answerOf("general_frustum", inputs);
        inputs["policy"] = other;
        EXPECT_EQ(answerOf("general_frustum", inputs), first) << one;
    }
    inputs["policy"] = "given";
    inputs["kappa"] = 0;
    const json given = answerOf("general_frustum", inputs);
    inputs["policy"] = "none";
    EXPECT_EQ(answerOf("general_frustum", inputs), given) << "no warp is the warp of kappa 0";
    inputs["policy"] = "eta";
    inputs["eta"] = -1;
    EXPECT_NEAR(answerOf("general_frustum", inputs)["S"].get<double>(), given["S"].get<double>(), 1e-9);
}

TEST(RowErrors, InfinityIsAWord) {
    const json& row = families().at("eq11_eta");
    json inputs = row["inputs"];
    inputs["eta"] = -1;
    EXPECT_EQ(answerOf("eq11_eta", inputs)["n_prime"], "inf");
    json overhead = families().at("eq9_eq10_eq12_overhead")["inputs"];
    overhead["n_prime"] = "inf";
    EXPECT_TRUE(answerOf("eq9_eq10_eq12_overhead", overhead)["S_bar"].is_number());
    overhead["n_prime"] = "infinite";
    EXPECT_NE(refusal("eq9_eq10_eq12_overhead", overhead), "");
}

TEST(RowErrors, EachRowIsAnsweredAsIfItWereAlone) {
    json rows = json::array();
    for (const auto& [family, row] : families())
        rows.push_back({{"family", family}, {"inputs", row["inputs"]}, {"id", {{"any", family}}}});
    const json together = evaluateRows({{"rows", rows}}, "rows.json")["rows"];
    ASSERT_EQ(together.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(together[i]["id"], rows[i]["id"]) << "an id is kept whatever it is";
        EXPECT_EQ(together[i]["got"], answerOf(rows[i]["family"], rows[i]["inputs"]));
        EXPECT_EQ(together[i].size(), 2U);
    }
}

TEST(RowErrors, AreCountedFromZeroAndEndTheDocument) {
    json rows = json::array();
    for (int i = 0; i < 3; ++i)
        rows.push_back({{"family", "eq15_eq16_planes"}, {"inputs", {{"n", 1}, {"f", 100}, {"k", 2}}}});
    rows[2]["family"] = "eq99";
    try {
        evaluateRows({{"rows", rows}}, "rows.json");
        FAIL();
    } catch (const Error& error) {
        const std::string said = error.what();
        EXPECT_TRUE(said.starts_with("rows.json: row 2: unknown family: expected one of ")) << said;
        EXPECT_TRUE(said.ends_with(", tsm_80, found eq99")) << said;
    }
    for (const json& none :
         {json(), json(3), json::array(), json::object(), json{{"rows", 3}}, json{{"rows", {{}, 2}}}})
        EXPECT_THROW(evaluateRows(none, "rows.json"), Error) << none;
    EXPECT_EQ(evaluateRows({{"rows", json::array()}}, "rows.json"), (json{{"rows", json::array()}}));
}

} // namespace
} // namespace gnomon::theory
