// A run's figures against figures counted out of its rows one by one; and what a bench writes down of them.
#include "bench/bench_output.h"
#include "bench/results_of_runs.h"
#include "bench/summarize.h"
#include "core/random.h"
#include "settings/axes.h"
#include "settings/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace gnomon::bench {
namespace {

using telemetry::FrameRow;

std::optional<double> maybe(Random& random, double max) {
    return random.below(4) == 0 ? std::nullopt : std::optional(random.uniform(0, max));
}

RunResult anyResult(Random& random) {
    RunResult result;
    result.run.name = "run";
    result.cpuMs = random.uniform(1, 9);
    const auto repetitions = 1 + static_cast<int>(random.below(3));
    const auto frames = 1 + static_cast<int>(random.below(6));
    for (int repetition = 0; repetition < repetitions; ++repetition)
        for (int frame = 0; frame < frames; ++frame) {
            FrameRow row;
            row.repetition = repetition;
            row.frame = frame;
            row.totalMs = random.uniform(5, 50);
            row.planMs = maybe(random, 1);
            row.shadowMs = maybe(random, 9);
            row.shadowMaps = static_cast<int>(random.below(6));
            row.imageTriangles = static_cast<std::int64_t>(random.below(1000));
            if (random.below(2) == 0) row.shadowTriangles = static_cast<std::int64_t>(random.below(1000));
            row.aliasingBoundX = maybe(random, 4);
            row.aliasingBoundZ = maybe(random, 4);
            row.measuredAliasing = maybe(random, 4);
            row.wrongShadowFraction = maybe(random, 0.1);
            row.missedShadowFraction = maybe(random, 0.1);
            row.shadowEdgeP99Px = maybe(random, 9);
            row.imageDifference = maybe(random, 0.1);
            row.crawl = maybe(random, 0.1);
            row.storageFactor = maybe(random, 99);
            if (random.below(3) != 0) row.isBoundKept = random.below(8) != 0;
            row.pagesDamaged = static_cast<std::int64_t>(random.below(3));
            row.pagesMissing = static_cast<std::int64_t>(random.below(9));
            result.rows.push_back(row);
        }
    return result;
}

std::vector<double> known(const RunResult& result, std::optional<double> FrameRow::*column) {
    std::vector<double> values;
    for (const FrameRow& row : result.rows)
        if (row.*column) values.push_back(*(row.*column));
    return values;
}

/// The middle value, or the middle between the two of them.
double middleOf(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double meanOf(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values)
        sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

TEST(RandomSummary, HasMediansMeansAndWorstOfItsRows) {
    Random random(1);
    for (int trial = 0; trial < 300; ++trial) {
        const RunResult result = anyResult(random);
        const report::RunSummary told = summarize(result);
        EXPECT_NEAR(told.p50Ms, middleOf(known(result, &FrameRow::totalMs)), 1e-9);
        EXPECT_LE(told.p50Ms, told.p95Ms);
        EXPECT_LE(told.p95Ms, told.p99Ms);
        EXPECT_NEAR(told.stages.plan, middleOf(known(result, &FrameRow::planMs)), 1e-9);
        EXPECT_NEAR(told.stages.shadow, middleOf(known(result, &FrameRow::shadowMs)), 1e-9);
        EXPECT_EQ(told.stages.image, 0) << "nobody measured it";
        double images = 0;
        double shadows = 0;
        int maps = 0;
        bool isKept = true;
        std::uint64_t damaged = 0;
        std::uint64_t missing = 0;
        for (const FrameRow& row : result.rows) {
            images += static_cast<double>(*row.imageTriangles) / static_cast<double>(result.rows.size());
            shadows += static_cast<double>(row.shadowTriangles.value_or(0)) / static_cast<double>(result.rows.size());
            maps = std::max(maps, static_cast<int>(row.shadowMaps));
            isKept = isKept && row.isBoundKept.value_or(true);
            damaged = std::max(damaged, static_cast<std::uint64_t>(*row.pagesDamaged));
            missing = std::max(missing, static_cast<std::uint64_t>(*row.pagesMissing));
        }
        EXPECT_NEAR(told.imageTriangles, images, 1e-9);
        EXPECT_NEAR(told.shadowTriangles, shadows, 1e-9);
        EXPECT_EQ(told.shadowMaps, maps);
        EXPECT_EQ(told.isBoundKept, isKept);
        EXPECT_EQ(told.pagesDamaged, damaged);
        EXPECT_EQ(told.pagesMissing, missing);
    }
}

TEST(RandomSummary, KnowsTheErrorsThatSomeFrameWasMeasuredFor) {
    using report::ErrorKind;
    Random random(2);
    for (int trial = 0; trial < 300; ++trial) {
        RunResult result = anyResult(random);
        if (random.below(4) == 0)
            for (FrameRow& row : result.rows)
                row.wrongShadowFraction.reset();
        const report::RunSummary told = summarize(result);
        const auto expect = [&](ErrorKind kind, bool isKnown, double value) {
            ASSERT_EQ(told.errors.contains(kind), isKnown) << report::key(kind);
            if (isKnown) {
                EXPECT_NEAR(told.errors.at(kind), value, 1e-12) << report::key(kind);
            }
        };
        const auto largest = [](const std::vector<double>& values) {
            return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
        };
        const std::vector<double> measured = known(result, &FrameRow::measuredAliasing);
        const std::vector<double> wrong = known(result, &FrameRow::wrongShadowFraction);
        const std::vector<double> edges = known(result, &FrameRow::shadowEdgeP99Px);
        const std::vector<double> pictures = known(result, &FrameRow::imageDifference);
        const double aliasingBound = std::max(
            largest(known(result, &FrameRow::aliasingBoundX)), largest(known(result, &FrameRow::aliasingBoundZ)));
        expect(ErrorKind::AliasingBound, aliasingBound > 0, aliasingBound);
        expect(ErrorKind::MeasuredAliasing, !measured.empty(), largest(measured));
        const double missed = meanOf(known(result, &FrameRow::missedShadowFraction));
        expect(ErrorKind::WrongShadow, !wrong.empty(), meanOf(wrong) + missed);
        expect(ErrorKind::ShadowEdge, !edges.empty(), middleOf(edges));
        expect(ErrorKind::ImageDifference, !pictures.empty(), meanOf(pictures));
        const std::vector<double> crawl = known(result, &FrameRow::crawl);
        EXPECT_NEAR(told.crawl, crawl.empty() ? -1 : meanOf(crawl), 1e-12);
    }
}

/// The median time of the rows of `result` that have `value` there.
double middleTime(const RunResult& result, std::int64_t FrameRow::*member, std::int64_t value) {
    std::vector<double> times;
    for (const FrameRow& row : result.rows)
        if (row.*member == value) times.push_back(*row.totalMs);
    return middleOf(times);
}

TEST(RandomSummary, HasTheNoiseOfItsRepetitionsAndTimesAlongThePath) {
    Random random(3);
    for (int trial = 0; trial < 300; ++trial) {
        RunResult result = anyResult(random);
        const std::int64_t repetitions = result.rows.back().repetition + 1;
        const std::int64_t frames = result.rows.back().frame + 1;
        std::vector<double> medians;
        for (std::int64_t repetition = 0; repetition < repetitions; ++repetition)
            medians.push_back(middleTime(result, &FrameRow::repetition, repetition));
        const report::RunSummary told = summarize(result);
        ASSERT_EQ(told.noise.has_value(), repetitions > 1);
        const auto [min, max] = std::minmax_element(medians.begin(), medians.end());
        if (told.noise) {
            EXPECT_NEAR(*told.noise, (*max - *min) / 2 / ((*max + *min) / 2), 1e-12);
        }
        ASSERT_EQ(told.frameMs.size(), static_cast<std::size_t>(frames));
        for (std::int64_t frame = 0; frame < frames; ++frame)
            EXPECT_NEAR(
                told.frameMs[static_cast<std::size_t>(frame)], middleTime(result, &FrameRow::frame, frame), 1e-9);
    }
}

TEST(RandomSummary, NamesEverySweptSettingByItsColumn) {
    RunResult result;
    result.rows.resize(1);
    result.run.settings.quality.filter = 3;
    const report::RunSummary told = summarize(result);
    std::size_t swept = 0;
    for (const settings::Setting& each : settings::table()) {
        if (!each.description().isSwept) continue;
        ++swept;
        EXPECT_EQ(told.settings.at(each.column()), each.text(result.run.settings));
    }
    EXPECT_EQ(told.settings.size(), swept);
    EXPECT_EQ(told.settings.at("filter"), "3");
}

std::vector<BenchRun> anyRuns(Random& random) {
    std::vector<settings::Axis> axes;
    const auto axis = [&](const char* name, const char* list) {
        if (random.below(2) == 0) axes.push_back(parseAxis(settings::named(name), name, list));
    };
    axis("error-pixels", "1,2,4");
    axis("warp", "none,auto");
    axis("filter", "3");
    axis("cull-casters", "on,off");
    return runsOf(settings::combinations(settings::Settings(), axes));
}

TEST(StatedSettings, AreThoseThatNoNameOfARunSays) {
    Random random(4);
    for (int trial = 0; trial < 60; ++trial) {
        const std::vector<BenchRun> runs = anyRuns(random);
        const auto stated = statedSettings(runs);
        std::set<std::string> names;
        for (const BenchRun& run : runs)
            EXPECT_TRUE(names.insert(run.name).second) << run.name;
        for (const settings::Setting& each : settings::table()) {
            if (!each.description().isSwept) continue;
            const bool isNamed = runs.front().name.find(each.column() + ":") != std::string::npos;
            EXPECT_NE(stated.contains(each.column()), isNamed) << each.column();
            if (!isNamed) {
                EXPECT_EQ(stated.at(each.column()), each.text(runs.front().settings));
            }
        }
    }
}

TEST(StatedSettings, JoinWhatIsStatedTogether) {
    BenchRun run;
    run.settings.quality.near = 0.5;
    const auto stated = statedSettings({run});
    EXPECT_EQ(stated.at("near_and_far"), "0.5, auto");
    EXPECT_EQ(stated.at("max_triangles"), "not given");
    EXPECT_EQ(stated.at("image_size"), "800x800");
    EXPECT_EQ(stated.at("memory_cap"), "1G");
    EXPECT_FALSE(stated.contains("camera")) << "a bench has a path";
}

TEST(BenchOutput, HasALineAndABenchmarkForEachRow) {
    Random random(5);
    std::vector<RunResult> results;
    std::size_t rows = 0;
    for (int i = 0; i < 5; ++i) {
        results.push_back(anyResult(random));
        results.back().run.name = std::to_string(i);
        for (FrameRow& row : results.back().rows)
            row.run = results.back().run.name;
        rows += results.back().rows.size();
    }
    std::istringstream lines(csvText(results));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, telemetry::csvHeader());
    for (const RunResult& result : results)
        for (const FrameRow& row : result.rows) {
            ASSERT_TRUE(std::getline(lines, line));
            EXPECT_EQ(line, telemetry::csvRow(row));
            --rows;
        }
    EXPECT_EQ(rows, 0U);
    EXPECT_FALSE(std::getline(lines, line));
    const ResultSet set = resultSet({{"model", "m.gnm"}}, results, false);
    ASSERT_EQ(set.runs.size(), results.size());
    for (std::size_t i = 0; i < results.size(); ++i) {
        const report::RunSummary told = summarize(results[i]);
        EXPECT_EQ(set.runs[i].label, told.name);
        EXPECT_NEAR(medianOf(set.runs[i].realMs), told.p50Ms, 1e-9);
        EXPECT_EQ(set.runs[i].pagesMissing, told.pagesMissing);
        EXPECT_EQ(set.runs[i].pagesDamaged, told.pagesDamaged);
        std::int64_t triangles = 0;
        for (const FrameRow& row : results[i].rows)
            if (row.repetition == 0) triangles += row.imageTriangles.value_or(0) + row.shadowTriangles.value_or(0);
        EXPECT_EQ(set.runs[i].work.at("triangles"), static_cast<double>(triangles));
        EXPECT_TRUE(resultSet({}, results, true).runs[i].work.empty()) << "in real time";
    }
}

TEST(StoragePoints, AreThoseOfTheDepthRangeAndNoneWithoutOne) {
    plan::FramePlan plan;
    plan.near = 1;
    plan.far = 1000;
    plan.view.camera.fovYRadians = 0.6981317007977318; // the frustum of the theory's figures
    plan.towardsLight = {0, 1, 0};
    const std::vector<report::StoragePoint> points = storagePoints(plan);
    ASSERT_EQ(points.size(), 32U);
    EXPECT_NEAR(points[8].storageFactor, 1372, 1);
    EXPECT_NEAR(points[11].storageFactor, 25.4, 0.05);
    EXPECT_EQ(points[11].maps, 4);
    EXPECT_EQ(points[11].scheme, "slices + warp");
    EXPECT_NEAR(points[24].storageFactor, 9.489, 1e-3) << "logarithmic rows";
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        EXPECT_TRUE(points[i].scheme != points[i + 1].scheme || points[i].maps < points[i + 1].maps);
    for (const auto& [near, far] : std::vector<std::pair<double, double>>{{0, 10}, {5, 5}, {6, 5}, {-1, 2}}) {
        plan.near = near;
        plan.far = far;
        EXPECT_TRUE(storagePoints(plan).empty()) << near << " to " << far;
    }
}

} // namespace
} // namespace gnomon::bench
