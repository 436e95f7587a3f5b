// Every column of the log by its own value, and JSON of strings that are no UTF-8.
#include "core/error.h"
#include "telemetry/benchmark_report.h"
#include "telemetry/frame_row.h"
#include "telemetry/json_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include <nlohmann/json.hpp>

namespace gnomon::telemetry {
namespace {

/// Fills what is measured of `row`, each with a number that no other has.
void fillMeasured(FrameRow& row) {
    std::int64_t whole = 1000;
    for (std::optional<std::int64_t>* field :
         {&row.imageTriangles, &row.shadowTriangles, &row.shadowFragments, &row.castersTested,
          &row.castersKept,    &row.drawCalls,       &row.residentBytes,   &row.gpuBytes,
          &row.bytesRead,      &row.pagesMissing,    &row.pagesDamaged,    &row.shadowSamples,
          &row.shadowCells,    &row.sampleTests,     &row.exactDecisions,  &row.pixelsWithinTolerance,
          &row.clustersHidden, &row.imageWidthDrawn, &row.samplesPerPixel, &row.trianglesSetUp,
          &row.pagesRead})
        *field = ++whole;
    double real = 0.5;
    for (std::optional<double>* field :
         {&row.planMs,
          &row.selectMs,
          &row.cullMs,
          &row.streamMs,
          &row.shadowMs,
          &row.imageMs,
          &row.totalMs,
          &row.achievedErrorPixels,
          &row.near,
          &row.far,
          &row.depthRatio,
          &row.lightAngle,
          &row.storageFactor,
          &row.aliasingBoundX,
          &row.aliasingBoundZ,
          &row.measuredAliasing,
          &row.wrongShadowFraction,
          &row.shadowEdgeP99Px,
          &row.imageDifference,
          &row.crawl,
          &row.sinceStartMs,
          &row.missedShadowFraction,
          &row.unexplainedShadowFraction,
          &row.wrongPixelsAll,
          &row.sunAngle,
          &row.lightError})
        *field = real += 1;
}

/// A row in which every field has a value that no other has.
FrameRow fullRow() {
    FrameRow row;
    row.run = "run";
    row.model = "model";
    row.scheme = "scheme";
    row.warp = "warp";
    row.facePartitions = "faces";
    row.shadowTexels = "64x64";
    row.backend = "backend";
    row.shadows = "shadows";
    row.occlusion = "occlusion";
    std::int64_t whole = 100;
    for (std::int64_t* field :
         {&row.repetition,
          &row.frame,
          &row.zPartitions,
          &row.filter,
          &row.shadowMaps,
          &row.shadowMapsDrawn,
          &row.width,
          &row.height})
        *field = ++whole;
    row.timeS = 1.25;
    row.errorPixels = 2.25;
    fillMeasured(row);
    row.isBoundKept = true;
    row.stabilize = true;
    row.cullCasters = "receivers";
    return row;
}

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result(1);
    for (const char c : line) {
        if (c == ',')
            result.emplace_back();
        else
            result.back() += c;
    }
    return result;
}

TEST(Columns, EachHasAFieldOfItsOwn) {
    const FrameRow row = fullRow();
    const std::vector<std::string> values = cells(csvRow(row));
    ASSERT_EQ(values.size(), columns().size());
    std::set<std::string> seen;
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NE(values[i], "") << columns()[i].name;
        if (values[i] == "on" || values[i] == "off") continue;
        EXPECT_TRUE(seen.insert(values[i]).second)
            << columns()[i].name << " shows " << values[i] << ", as another does";
    }
    std::set<std::string_view> names;
    for (const Column& column : columns())
        EXPECT_TRUE(names.insert(column.name).second) << column.name;
}

TEST(Columns, HoldTheFieldsThatTheirNamesSay) {
    const FrameRow row = fullRow();
    const auto object = nlohmann::json::parse(jsonObject(row));
    EXPECT_EQ(object.at("run"), "run");
    EXPECT_EQ(object.at("repetition"), row.repetition);
    EXPECT_EQ(object.at("frame"), row.frame);
    EXPECT_EQ(object.at("time_s"), row.timeS);
    EXPECT_EQ(object.at("z_partitions"), row.zPartitions);
    EXPECT_EQ(object.at("shadow_maps"), row.shadowMaps);
    EXPECT_EQ(object.at("shadow_maps_drawn"), row.shadowMapsDrawn);
    EXPECT_EQ(object.at("stabilize"), true);
    EXPECT_EQ(object.at("cull_casters"), "receivers");
    EXPECT_EQ(object.at("total_ms"), *row.totalMs);
    EXPECT_EQ(object.at("plan_ms"), *row.planMs);
    EXPECT_EQ(object.at("image_triangles"), *row.imageTriangles);
    EXPECT_EQ(object.at("shadow_triangles"), *row.shadowTriangles);
    EXPECT_EQ(object.at("casters_tested"), *row.castersTested);
    EXPECT_EQ(object.at("casters_kept"), *row.castersKept);
    EXPECT_EQ(object.at("pages_missing"), *row.pagesMissing);
    EXPECT_EQ(object.at("pages_damaged"), *row.pagesDamaged);
    EXPECT_EQ(object.at("promised_aliasing_x"), *row.aliasingBoundX);
    EXPECT_EQ(object.at("promised_aliasing_z"), *row.aliasingBoundZ);
    EXPECT_EQ(object.at("promise_kept"), true);
    EXPECT_EQ(object.at("wrong_shadow_fraction"), *row.wrongShadowFraction);
    EXPECT_EQ(object.at("missed_shadow_fraction"), *row.missedShadowFraction);
    EXPECT_EQ(object.at("since_start_ms"), *row.sinceStartMs);
}

TEST(Columns, ALineBreakInANameStaysInItsCell) {
    FrameRow row;
    row.model = "a\nb\rc";
    EXPECT_NE(csvRow(row).find(",\"a\nb\rc\","), std::string::npos);
    row.model = "plain";
    EXPECT_NE(csvRow(row).find(",plain,"), std::string::npos);
}

TEST(JsonText, ReplacesWhatIsNoUtf8AndWritesAscii) {
    EXPECT_EQ(
        jsonText(nlohmann::json("a\xff"
                                "b")),
        R"("a\ufffdb")");
    EXPECT_EQ(jsonText(nlohmann::json{{"a", 1}}), "{\"a\":1}");
    EXPECT_EQ(jsonText(nlohmann::json{{"a", 1}}, 1), "{\n \"a\": 1\n}");
}

TEST(Quantile, IsThatOfTheSortedValuesWhateverTheirOrder) {
    std::vector<double> values(101);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<double>((i * 37) % 101);
    for (const double fraction : {0.0, 0.01, 0.25, 0.5, 0.95, 1.0})
        EXPECT_NEAR(quantile(values, fraction), 100 * fraction, 1e-9);
    EXPECT_NEAR(quantile(values, 0.505), 50.5, 1e-9) << "linear between ranks";
}

} // namespace
} // namespace gnomon::telemetry
