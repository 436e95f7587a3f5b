// The cells of a row of the log at random: a plain reader of CSV and JSON finds again whatever stands in them.
#include "core/random.h"
#include "telemetry/frame_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <nlohmann/json.hpp>

namespace gnomon::telemetry {
namespace {

/// The cells of a line of CSV, by the letter of RFC 4180, with whether each was quoted.
std::vector<std::pair<std::string, bool>> cellsOf(const std::string& line) {
    std::vector<std::pair<std::string, bool>> cells(1);
    bool isInside = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (isInside) {
            if (c != '"')
                cells.back().first += c;
            else if (i + 1 < line.size() && line[i + 1] == '"')
                cells.back().first += line[++i];
            else
                isInside = false;
        } else if (c == '"') {
            EXPECT_TRUE(cells.back().first.empty()) << "a quote within a cell: " << line;
            isInside = true;
            cells.back().second = true;
        } else if (c == ',') {
            cells.emplace_back();
        } else {
            cells.back().first += c;
        }
    }
    EXPECT_FALSE(isInside) << "a quote that never ends: " << line;
    return cells;
}

std::map<std::string, std::string> cellsByName(const FrameRow& row) {
    const auto names = cellsOf(csvHeader());
    const auto cells = cellsOf(csvRow(row));
    EXPECT_EQ(names.size(), cells.size());
    std::map<std::string, std::string> result;
    for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i)
        result[names[i].first] = cells[i].first;
    return result;
}

TEST(Cells, OfARowOfNothingAreEmptyWhereNothingWasMeasured) {
    const auto cells = cellsByName(FrameRow());
    const auto object = nlohmann::json::parse(jsonObject(FrameRow()));
    for (const Column& column : columns()) {
        const std::string name(column.name);
        const bool isUnmeasured = std::holds_alternative<std::monostate>(column.value(FrameRow()));
        EXPECT_EQ(object.at(name).is_null(), isUnmeasured) << name;
        if (isUnmeasured) {
            EXPECT_EQ(cells.at(name), "") << name;
        }
    }
    EXPECT_EQ(cells.at("total_ms"), "");
    EXPECT_EQ(cells.at("promise_kept"), "");
    EXPECT_EQ(cells.at("frame"), "0") << "a count of 0 is one";
}

TEST(Cells, KeepAnyTextThatANameMayHold) {
    Random random(1);
    const std::string letters = "ab,\"\n\r \t;'é";
    for (int i = 0; i < 2000; ++i) {
        FrameRow row;
        for (std::string* text : {&row.run, &row.model, &row.scheme, &row.backend})
            for (std::uint64_t length = random.below(8); length > 0; --length)
                *text += letters[random.below(9)];
        const auto cells = cellsByName(row);
        EXPECT_EQ(cells.at("run"), row.run);
        EXPECT_EQ(cells.at("model"), row.model);
        EXPECT_EQ(cells.at("scheme"), row.scheme);
        EXPECT_EQ(cells.at("backend"), row.backend);
    }
}

TEST(Cells, AreQuotedOnlyWhereTheyMustBe) {
    FrameRow row;
    for (const auto& [text, isQuoted] : std::map<std::string, bool>{
             {"plain text; it's", false}, {"a,b", true}, {"a\"b", true}, {"a\nb", true}, {"a\rb", true}, {"", false}}) {
        row.run = text;
        EXPECT_EQ(cellsOf(csvRow(row)).front().second, isQuoted) << text;
    }
}

TEST(Cells, HoldNumbersOfAnySizeToTheLastBit) {
    Random random(2);
    for (int i = 0; i < 3000; ++i) {
        FrameRow row;
        const double value = random.uniform(-1, 1) * std::pow(10, random.uniform(-300, 300));
        row.near = value;
        row.timeS = -value;
        row.bytesRead = static_cast<std::int64_t>(random.bits());
        const auto cells = cellsByName(row);
        EXPECT_EQ(std::stod(cells.at("near")), value);
        EXPECT_EQ(std::stod(cells.at("time_s")), -value);
        EXPECT_EQ(std::stoll(cells.at("bytes_read")), *row.bytesRead);
        const auto object = nlohmann::json::parse(jsonObject(row));
        EXPECT_EQ(object.at("near").get<double>(), value);
        EXPECT_EQ(object.at("bytes_read").get<std::int64_t>(), *row.bytesRead);
    }
}

TEST(Cells, WithoutANumberForInfinityAreEmpty) {
    for (const double value : {std::numeric_limits<double>::infinity(), -HUGE_VAL, std::nan("")}) {
        FrameRow row;
        row.storageFactor = value;
        row.errorPixels = value; // measured or not
        EXPECT_EQ(cellsByName(row).at("storage_factor"), "");
        EXPECT_EQ(cellsByName(row).at("error_pixels"), "");
        EXPECT_TRUE(nlohmann::json::parse(jsonObject(row)).at("storage_factor").is_null());
    }
}

TEST(Cells, AreInTheSameOrderAsJson) {
    const auto object = nlohmann::ordered_json::parse(jsonObject(FrameRow()));
    std::string keys;
    for (const auto& [key, value] : object.items())
        keys += (keys.empty() ? "" : ",") + key;
    EXPECT_EQ(keys, csvHeader());
}

} // namespace
} // namespace gnomon::telemetry
