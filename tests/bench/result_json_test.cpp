// The file of a bench: what is written is read back, earlier files are read, and everything else is refused.
#include "bench/alike_keys.h"
#include "bench/bench_output.h"
#include "bench/result_formats.h"
#include "bench/result_json.h"
#include "bench/results_of_runs.h"
#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "settings/usage_error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>
#include <set>

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace gnomon::bench {
namespace {

const std::string& filePath() {
    static const std::string path = testing::TempDir() + "gnomon_results_" + std::to_string(::getpid()) + ".json";
    return path;
}

ResultSet readText(const std::string& text) {
    writeTextFile(filePath(), text);
    try {
        ResultSet set = readResultSet(filePath());
        std::filesystem::remove(filePath());
        return set;
    } catch (...) {
        std::filesystem::remove(filePath());
        throw;
    }
}

template <class Do>
std::string objection(const Do& action) {
    try {
        action();
        return {};
    } catch (const Error& error) {
        return error.what();
    } catch (const settings::UsageError& error) {
        return error.message;
    }
}

ResultSet anySet(Random& random) {
    ResultSet set;
    set.context = {{"cpu", "a \"quoted\" name"}, {"threads", "2"}, {"num_cpus", "4"}, {"light", "0,1,0"}};
    const std::uint64_t runs = 1 + random.below(4);
    for (std::uint64_t i = 0; i < runs; ++i) {
        RunRecord& run = set.runs.emplace_back();
        run.name = "m/p/maps/8x8/" + std::to_string(i) + "px/software";
        run.label = "error_pixels:" + std::to_string(i);
        const std::uint64_t frames = 1 + random.below(9);
        for (std::uint64_t r = 0; r < 1 + i; ++r) {
            run.realMs.emplace_back();
            run.cpuMs.emplace_back();
            for (std::uint64_t frame = 0; frame < frames; ++frame) {
                run.realMs.back().push_back(std::exp(random.uniform(-5, 9)));
                run.cpuMs.back().push_back(random.uniform(1, 9));
            }
        }
        run.work = {{"triangles", static_cast<double>(random.below(1U << 30U))}};
        run.errors = {{"promised_aliasing", random.unit()}, {"wrong_pixels_all", 0}};
        run.pagesDamaged = random.below(3);
        run.pagesMissing = random.below(3);
    }
    set.runs.front().process = {{kPeakMemory, {1e8}}, {kFirstPicture, {120}}};
    return set;
}

TEST(ResultJson, IsReadBack) {
    Random random(1);
    for (int trial = 0; trial < 50; ++trial) {
        const ResultSet set = anySet(random);
        const ResultSet read = readText(resultJson(set));
        EXPECT_EQ(read.path, filePath());
        EXPECT_EQ(read.context, set.context);
        EXPECT_FALSE(read.hasOnlyTimes);
        ASSERT_EQ(read.runs.size(), set.runs.size());
        for (std::size_t i = 0; i < set.runs.size(); ++i) {
            const RunRecord& before = set.runs[i];
            const RunRecord& now = read.runs[i];
            EXPECT_EQ(now.name, before.name);
            EXPECT_EQ(now.label, before.label);
            EXPECT_EQ(now.work, before.work);
            EXPECT_EQ(now.errors, before.errors);
            EXPECT_EQ(now.process, before.process);
            EXPECT_EQ(now.pagesDamaged, before.pagesDamaged);
            EXPECT_EQ(now.pagesMissing, before.pagesMissing);
            ASSERT_EQ(now.realMs.size(), before.realMs.size());
            for (std::size_t r = 0; r < before.realMs.size(); ++r)
                for (std::size_t frame = 0; frame < before.realMs[r].size(); ++frame) {
                    EXPECT_NEAR(now.realMs[r][frame] / before.realMs[r][frame], 1, 1e-5) << "six digits";
                    EXPECT_NEAR(now.cpuMs[r][frame] / before.cpuMs[r][frame], 1, 1e-5);
                }
        }
        EXPECT_EQ(resultJson(read), resultJson(readText(resultJson(read)))) << "rounding happens once";
    }
}

// One entry per repetition and four aggregates of several, with the keys that Google's tools read.
TEST(ResultJson, HasTheFormOfGoogleBenchmark) {
    Random random(2);
    const ResultSet set = anySet(random);
    const auto document = nlohmann::json::parse(resultJson(set));
    EXPECT_EQ(document.at("context").at("num_cpus"), 4);
    EXPECT_TRUE(document.at("context").at("caches").is_array());
    std::size_t at = 0;
    for (const RunRecord& run : set.runs) {
        double sum = 0;
        for (std::size_t r = 0; r < run.realMs.size(); ++r, ++at) {
            const auto& entry = document.at("benchmarks").at(at);
            EXPECT_EQ(entry.at("run_type"), "iteration");
            EXPECT_EQ(entry.at("repetition_index"), r);
            EXPECT_EQ(entry.at("repetitions"), run.realMs.size());
            EXPECT_EQ(entry.at("iterations"), run.realMs[r].size());
            EXPECT_EQ(entry.at("threads"), 2);
            EXPECT_EQ(entry.at("work_triangles"), run.work.at("triangles"));
            const double mean = std::accumulate(run.realMs[r].begin(), run.realMs[r].end(), 0.0) /
                                static_cast<double>(run.realMs[r].size());
            EXPECT_NEAR(entry.at("real_time").get<double>(), mean, 1e-9 * mean);
            sum += mean;
        }
        if (run.realMs.size() < 2) continue;
        for (const char* kind : {"mean", "median", "stddev", "cv"}) {
            const auto& entry = document.at("benchmarks").at(at++);
            EXPECT_EQ(entry.at("name"), run.name + "_" + kind);
            EXPECT_EQ(entry.at("run_name"), run.name);
            EXPECT_EQ(entry.at("run_type"), "aggregate");
            if (kind == std::string("mean")) {
                EXPECT_NEAR(
                    entry.at("real_time").get<double>(), sum / static_cast<double>(run.realMs.size()), 1e-6 * sum);
            }
        }
    }
    EXPECT_EQ(document.at("benchmarks").size(), at);
}

TEST(ResultJson, OfTheEarlierFormHasOnlyTimes) {
    const ResultSet set = readText(
        R"({"context": {"cpu": "a", "n": 3, "c": null, "d": []},
            "benchmarks": [{"name": "z_partitions:1", "p50": 12.5, "cpu_time": 20, "pages_missing": 2}]})");
    EXPECT_TRUE(set.hasOnlyTimes);
    EXPECT_EQ(set.context, (std::map<std::string, std::string>{{"cpu", "a"}, {"n", "3"}}));
    ASSERT_EQ(set.runs.size(), 1U);
    EXPECT_EQ(set.runs.front().label, "z_partitions:1");
    EXPECT_EQ(set.runs.front().realMs, (Times{{12.5}}));
    EXPECT_EQ(set.runs.front().cpuMs, (Times{{20}}));
    EXPECT_EQ(set.runs.front().pagesMissing, 2U);
    EXPECT_TRUE(set.runs.front().work.empty());
}

TEST(ResultJson, OfAnotherShapeIsRefusedWithItsPlace) {
    for (const char* text :
         {"3", "[]", "{}", R"({"context": {}})", R"({"benchmarks": []})", R"({"context": [], "benchmarks": []})"})
        EXPECT_EQ(
            objection([&] { readText(text); }),
            filePath() +
                R"(: this file is not a bench result: expected {"context": {...}, "benchmarks": [...]}, found something else)")
            << text;
    const std::string good = R"({"name": "a", "p50": 1})";
    for (const char* bad :
         {"3",
          "[]",
          "{}",
          R"({"name": "a"})",
          R"({"p50": 1})",
          R"({"name": 1, "p50": 1})",
          R"({"name": "a", "p50": "1"})",
          R"({"name": "a", "p50": null})"}) {
        const std::string text = R"({"context": {}, "benchmarks": [)" + good + ", " + bad + "]}";
        EXPECT_TRUE(
            objection([&] { readText(text); }).starts_with(filePath() + ": benchmark 1: this entry is not a run"))
            << bad;
    }
    EXPECT_NE(objection([] { readText(R"({"context": {}, )"); }), "");
    EXPECT_NE(objection([] { readResultSet("/no/such/baseline.json"); }), "");
}

TEST(ResultJson, WithARemovedWordIsRefusedWithTheReplacement) {
    for (const char* text :
         {R"({"context": {"warp": "fitted"}, "benchmarks": []})",
          R"({"context": {}, "benchmarks": [{"name": "error_pixels:1/warp:fitted/filter:3", "p50": 1}]})"})
        EXPECT_NE(objection([&] { refuseRemovedWords(readText(text)); }).find("use --warp log"), std::string::npos)
            << text;
}

// Contexts that differ in any compared key are not comparable; those that differ in a date or a compiler are.
TEST(AlikeKeys, AreWhatTimesDependOn) {
    ResultSet before;
    before.context = statedSettings({BenchRun{"run", settings::Settings(), ""}});
    for (const char* fact :
         {"model_content_hash",
          "model_source",
          "path_content_hash",
          "frames",
          "real_time",
          "backend",
          "threads",
          "options",
          "picture",
          "cpu",
          "library_build_type"})
        before.context[fact] = std::string("that ") + fact;
    for (const bool isOld : {false, true}) {
        before.hasOnlyTimes = isOld;
        Limits limits;
        limits.alikeKeys = alikeKeys(before, before.context, false);
        EXPECT_TRUE(contextGates(before, before.context, limits).empty());
        EXPECT_EQ(
            std::set<std::string>(limits.alikeKeys.begin(), limits.alikeKeys.end()).size(), limits.alikeKeys.size());
        for (const char* key : {"model_content_hash", "frames", "light", "image_size", "backend", "threads", "cpu"}) {
            auto now = before.context;
            now[key] = "other";
            EXPECT_EQ(contextGates(before, now, limits).size(), 1U) << key;
        }
        auto now = before.context;
        now["date"] = "today";
        now["compiler"] = "another";
        now["model_source"] = "another";
        EXPECT_TRUE(contextGates(before, now, limits).empty());
        now = before.context;
        now["warp"] = "a changed default";
        EXPECT_EQ(contextGates(before, now, limits).size(), isOld ? 1U : 0U) << "work and accuracy judge it";
    }
    before.hasOnlyTimes = false;
    Limits limits;
    limits.alikeKeys = alikeKeys(before, before.context, true);
    auto now = before.context;
    now["model_content_hash"] = "other";
    EXPECT_TRUE(contextGates(before, now, limits).empty());
    now["model_source"] = "other";
    EXPECT_EQ(contextGates(before, now, limits).size(), 1U);
}

TEST(FullNames, ContainModelPathSchemeSizeErrorAndBackend) {
    RunResult result;
    result.run.name = "z_partitions:4";
    result.run.scheme = "maps,z_partitions:4";
    telemetry::FrameRow row;
    row.width = 64;
    row.height = 32;
    result.run.error = "0.5px";
    row.backend = "software";
    result.rows.push_back(row);
    EXPECT_EQ(
        fullName({{"model", "plant.gnm"}, {"path", "walk.json"}}, result),
        "plant/walk/maps,z_partitions:4/64x32/0.5px/software");
    EXPECT_EQ(fullName({}, result), "none/none/maps,z_partitions:4/64x32/0.5px/software");
}

/// Checks a benchmark of Bencher's reader (its BMF schema): {measure: {value, lower_value?, upper_value?}}, all
/// numbers.
void expectBmf(const nlohmann::json& benchmark) {
    for (const auto& [measure, value] : benchmark.items()) {
        EXPECT_EQ(measure.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"), std::string::npos);
        for (const auto& [key, number] : value.items()) {
            EXPECT_TRUE(key == "value" || key == "lower_value" || key == "upper_value");
            EXPECT_TRUE(number.is_number());
        }
    }
}

TEST(ResultFormats, AreWhatBencherReads) {
    Random random(3);
    for (int trial = 0; trial < 20; ++trial) {
        const ResultSet set = anySet(random);
        const auto bmf = nlohmann::json::parse(bmfJson(set));
        ASSERT_EQ(bmf.size(), set.runs.size());
        for (const RunRecord& run : set.runs) {
            expectBmf(bmf.at(run.name));
            EXPECT_NEAR(bmf[run.name]["latency"]["value"].get<double>(), 1e6 * medianOf(run.realMs), 1);
        }
    }
}

TEST(ResultFormats, AreWhatGithubActionBenchmarkReads) {
    Random random(3);
    for (int trial = 0; trial < 20; ++trial) {
        const ResultSet set = anySet(random);
        const auto action = nlohmann::json::parse(actionJson(set));
        std::set<std::string> names;
        for (const auto& entry : action) {
            EXPECT_TRUE(entry.at("name").is_string() && entry.at("unit").is_string() && entry.at("value").is_number());
            names.insert(entry.at("name").get<std::string>());
        }
        EXPECT_EQ(names.size(), action.size()) << "unique";
        const std::string markdown = summaryMarkdown(set, nullptr);
        EXPECT_EQ(std::count(markdown.begin(), markdown.end(), '\n'), static_cast<std::ptrdiff_t>(2 + set.runs.size()));
    }
}

} // namespace
} // namespace gnomon::bench
