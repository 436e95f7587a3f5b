#include "telemetry/benchmark_report.h"
#include "telemetry/frame_row.h"
#include "telemetry/process_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

namespace gnomon::telemetry {
namespace {

TEST(FrameRow, ColumnsAreThoseOfTheContractInItsOrder) {
    EXPECT_EQ(
        csvHeader(),
        "run,repetition,model,frame,time_s,scheme,warp,z_partitions,face_partitions,stabilize,filter,shadow_maps,"
        "shadow_maps_drawn,cull_casters,shadow_texels,error_pixels,width,height,backend,plan_ms,select_ms,cull_ms,"
        "stream_ms,shadow_ms,image_ms,total_ms,image_triangles,shadow_triangles,shadow_fragments,casters_tested,"
        "casters_kept,draw_calls,resident_bytes,gpu_bytes,bytes_read,pages_missing,pages_damaged,"
        "achieved_error_pixels,near,far,depth_ratio,light_angle,storage_factor,promised_aliasing_x,"
        "promised_aliasing_z,measured_aliasing,promise_kept,wrong_shadow_fraction,shadow_edge_p99_px,"
        "image_difference,crawl,since_start_ms,missed_shadow_fraction,unexplained_shadow_fraction,"
        "shadows,shadow_samples,shadow_cells,sample_tests,exact_decisions,touching_pixels,"
        "occlusion,clusters_hidden,wrong_pixels_all,image_width_drawn,samples_per_pixel,sun_angle,light_error,"
        "triangles_set_up,pages_read");
}

TEST(FrameRow, EveryRowHasEveryCell) {
    FrameRow row;
    row.run = "plain";
    const std::string header = csvHeader();
    const std::string line = csvRow(row);
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(header.begin(), header.end(), ','));
    row.run = "a,\"b\"";
    EXPECT_TRUE(csvRow(row).starts_with("\"a,\"\"b\"\"\",0,"));
}

TEST(FrameRow, NumbersReadBackTheSame) {
    FrameRow row;
    row.near = 0.1;
    row.far = 1.0 / 3.0;
    row.totalMs = 1e-7;
    const auto object = nlohmann::json::parse(jsonObject(row));
    EXPECT_EQ(object.at("near").get<double>(), 0.1);
    EXPECT_EQ(object.at("far").get<double>(), 1.0 / 3.0);
    EXPECT_NE(csvRow(row).find(",0.3333333333333333,"), std::string::npos);
    EXPECT_NE(csvRow(row).find(",1e-07,"), std::string::npos);
}

TEST(FrameRow, WhatWasNotMeasuredIsEmptyAndNull) {
    FrameRow row;
    row.depthRatio = std::numeric_limits<double>::infinity();
    const auto object = nlohmann::json::parse(jsonObject(row));
    EXPECT_EQ(object.size(), columns().size());
    EXPECT_TRUE(object.at("crawl").is_null());
    EXPECT_TRUE(object.at("depth_ratio").is_null());
    EXPECT_FALSE(object.at("stabilize").get<bool>());
    EXPECT_TRUE(csvRow(row).ends_with(",,"));
}

TEST(Quantile, InterpolatesBetweenRanks) {
    const std::vector<double> values = {4, 1, 3, 2};
    EXPECT_DOUBLE_EQ(quantile(values, 0), 1);
    EXPECT_DOUBLE_EQ(quantile(values, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(quantile(values, 1), 4);
    EXPECT_DOUBLE_EQ(quantile(std::vector<double>{7}, 0.99), 7);
}

TEST(ProcessClock, CountsFromTheStartOfTheProcess) {
    const double before = sinceProcessStart().count;
    EXPECT_GT(before, 0);
    EXPECT_LT(before, 600e3) << "a test takes no ten minutes";
    const double cpu = processorTime().count;
    while (processorTime().count < cpu + 1) {
    }
    EXPECT_GE(sinceProcessStart().count, before);
}

TEST(ProcessPeak, GrowsByWhatIsTouched) {
    constexpr std::size_t kBytes = std::size_t{64} << 20U;
    const std::uint64_t before = peakResident().count;
    const std::vector<char> touched(kBytes, 1);
    EXPECT_EQ(touched.back(), 1);
    EXPECT_GE(peakResident().count, kBytes);
    EXPECT_LT(peakResident().count, before + 2 * kBytes) << "bytes, and not another unit";
}

} // namespace
} // namespace gnomon::telemetry
