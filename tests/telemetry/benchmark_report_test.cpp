// The summary of a bench against figures counted out one by one.
#include "core/random.h"
#include "telemetry/benchmark_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace gnomon::telemetry {
namespace {

std::vector<double> anyTimes(Random& random) {
    std::vector<double> values(1 + random.below(40));
    for (double& value : values)
        value = static_cast<double>(random.below(50)) / 4; // with ties
    return values;
}

TEST(RandomQuantile, LiesBetweenTheRanksAroundIt) {
    Random random(1);
    for (int trial = 0; trial < 1000; ++trial) {
        const std::vector<double> values = anyTimes(random);
        const double fraction = random.below(4) == 0 ? 1.0 * static_cast<double>(random.below(2)) : random.unit();
        const double found = quantile(values, fraction);
        const auto notAbove = std::count_if(values.begin(), values.end(), [&](double v) { return v <= found; });
        const auto notBelow = std::count_if(values.begin(), values.end(), [&](double v) { return v >= found; });
        const auto last = static_cast<double>(values.size() - 1);
        EXPECT_GE(static_cast<double>(notAbove), std::floor(fraction * last) + 1);
        EXPECT_GE(static_cast<double>(notBelow), std::floor((1 - fraction) * last));
    }
}

TEST(RandomQuantile, HangsNeitherOnTheOrderNorJumps) {
    Random random(2);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<double> values = anyTimes(random);
        const double at = random.unit();
        const double before = quantile(values, at);
        std::reverse(values.begin(), values.end());
        EXPECT_EQ(quantile(values, at), before);
        const auto [min, max] = std::minmax_element(values.begin(), values.end());
        EXPECT_EQ(quantile(values, 0), *min);
        EXPECT_EQ(quantile(values, 1), *max);
        double last = *min;
        const double largestStep = (*max - *min) * 0.01 * static_cast<double>(values.size()) + 1e-9;
        for (int i = 0; i <= 100; ++i) {
            const double here = quantile(values, i / 100.0);
            EXPECT_GE(here, last - 1e-12);
            EXPECT_LE(here - last, largestStep);
            last = here;
        }
        std::vector<double> shifted = values;
        for (double& value : shifted)
            value = 3 * value + 2;
        EXPECT_NEAR(quantile(shifted, at), 3 * before + 2, 1e-9);
    }
}

TEST(BenchmarkContext, SpeaksOfThisMachineInAFormThatSorts) {
    const auto context = machineContext();
    const std::string& date = context.at("date");
    ASSERT_EQ(date.size(), std::string("2026-01-31T00:00:00Z").size()) << date;
    for (std::size_t i = 0; i < date.size(); ++i) {
        const char pattern = "dddd-dd-ddTdd:dd:ddZ"[i];
        EXPECT_TRUE(pattern == 'd' ? date[i] >= '0' && date[i] <= '9' : date[i] == pattern) << date;
    }
    EXPECT_GT(std::stoull(context.at("memory_bytes")), 1U << 20U);
    EXPECT_GT(std::stoi(context.at("num_cpus")), 0);
    for (const char* fact : {"cpu", "host_class", "governor", "load", "compiler", "commit"})
        EXPECT_FALSE(context.at(fact).empty()) << fact;
    EXPECT_TRUE(context.at("simd_bits") == "128" || std::stoi(context.at("simd_bits")) % 256 == 0);
    EXPECT_GE(stolenSeconds(), 0);
    EXPECT_TRUE(context.at("library_build_type") == "release" || context.at("library_build_type") == "debug");
}

} // namespace
} // namespace gnomon::telemetry
