// An earlier bench as a yardstick: what is none, what compares with what, and who became slower.
#include "bench/baseline.h"
#include "bench/bench_output.h"
#include "bench/bench_text.h"
#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "settings/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include <unistd.h>

namespace gnomon::bench {
namespace {

const std::string& filePath() {
    static const std::string path = testing::TempDir() + "gnomon_baseline_" + std::to_string(::getpid()) + ".json";
    return path;
}

/// What is made of a file of `text`.
Baseline readText(const std::string& text) {
    writeTextFile(filePath(), text);
    try {
        Baseline baseline = readBaseline(filePath());
        std::filesystem::remove(filePath());
        return baseline;
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
    }
}

/// A context of all that a baseline must agree in.
std::map<std::string, std::string> fullContext() {
    std::map<std::string, std::string> context = statedSettings({BenchRun{"run", settings::Settings(), ""}});
    for (const char* fact : {"model_content_hash", "path_content_hash", "frames", "real_time", "backend", "threads"})
        context[fact] = std::string("that ") + fact;
    return context;
}

/// What usage is found wrong.
template <class Do>
std::string usageObjection(const Do& action) {
    try {
        action();
        return {};
    } catch (const settings::UsageError& error) {
        return error.message;
    }
}

report::RunSummary runOf(const std::string& name, double p50Ms) {
    report::RunSummary run;
    run.name = name;
    run.p50Ms = p50Ms;
    return run;
}

TEST(Baseline, IsWhatABenchWroteBefore) {
    Random random(1);
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<RunResult> results(1 + random.below(5));
        for (std::size_t i = 0; i < results.size(); ++i) {
            results[i].run.name = "run " + std::to_string(i);
            for (std::uint64_t frame = 0; frame < 1 + random.below(9); ++frame) {
                telemetry::FrameRow row;
                row.totalMs = random.uniform(1, 100);
                results[i].rows.push_back(row);
            }
        }
        const Baseline baseline = readText(benchmarkText(fullContext(), results));
        EXPECT_EQ(baseline.path, filePath());
        EXPECT_EQ(baseline.context, fullContext());
        ASSERT_EQ(baseline.p50Ms.size(), results.size());
        std::vector<report::RunSummary> same;
        for (const auto& [name, p50Ms] : baseline.p50Ms)
            same.push_back(runOf(name, p50Ms));
        EXPECT_EQ(objection([&] { requireComparable(baseline, fullContext()); }), "");
        EXPECT_EQ(objection([&] { requireNotSlower(baseline, same, 0); }), "") << "than itself";
        EXPECT_TRUE(notCompared(baseline, same).empty());
    }
}

TEST(Baseline, WithARemovedWordIsRefusedWithTheReplacement) {
    for (const char* text :
         {R"({"context": {"warp": "fitted"}, "benchmarks": []})",
          R"({"context": {}, "benchmarks": [{"name": "error_pixels:1/warp:fitted/filter:3", "p50": 1}]})"})
        EXPECT_NE(usageObjection([&] { readText(text); }).find("use --warp log"), std::string::npos) << text;
    EXPECT_EQ(
        usageObjection([] { readText(R"({"context": {}, "benchmarks": [{"name": "warp:log", "p50": 1}]})"); }), "");
}

TEST(Baseline, OfAnotherShapeIsRefusedWithItsPlace) {
    for (const char* text :
         {"3",
          "[]",
          "{}",
          R"({"context": {}})",
          R"({"benchmarks": []})",
          R"({"context": [], "benchmarks": []})",
          R"({"context": {}, "benchmarks": {}})",
          R"({"context": null, "benchmarks": []})"})
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
    EXPECT_NE(objection([] { readBaseline("/no/such/baseline.json"); }), "");
}

TEST(Baseline, TakesOfTheContextWhatIsText) {
    const Baseline baseline = readText(R"({"context": {"a": "text", "b": 3, "c": null, "d": []}, "benchmarks": []})");
    EXPECT_EQ(baseline.context, (std::map<std::string, std::string>{{"a", "text"}}));
    EXPECT_TRUE(baseline.p50Ms.empty());
}

TEST(Baseline, MustAgreeInEverythingThatTimesHangOn) {
    const Baseline baseline{"before.json", fullContext(), {}};
    for (const auto& [key, value] : fullContext()) {
        auto now = fullContext();
        now[key] = "other";
        std::string expected = "before.json: the baseline is of another bench: ";
        expected.append(key).append(": expected other, found ").append(value);
        EXPECT_EQ(objection([&] { requireComparable(baseline, now); }), expected);
    }
    auto now = fullContext();
    now["date"] = "today";
    now["compiler"] = "another";
    EXPECT_EQ(objection([&] { requireComparable(baseline, now); }), "") << "times are compared across these";
}

TEST(Baseline, ThatSaysNothingOfSomethingDiffersInItUnlessThatIsSwept) {
    for (const auto& [key, value] : fullContext()) {
        Baseline baseline{"before.json", fullContext(), {}};
        baseline.context.erase(key);
        const auto all = settings::table();
        const bool isSwept = std::any_of(all.begin(), all.end(), [&, &column = key](const settings::Setting& each) {
            return each.description().isSwept && each.column() == column;
        });
        const std::string said = objection([&] { requireComparable(baseline, fullContext()); });
        const bool isNotGiven = value == "not given"; // as in a bench from before there was such an option
        EXPECT_EQ(said.empty(), isSwept || isNotGiven) << key << ": " << said;
        if (said.empty()) continue; // what is swept stands in the names of the runs
        EXPECT_TRUE(said.ends_with("expected " + value + ", found not given")) << said;
    }
}

TEST(Baseline, NamesTheRunsThatOnlyOneSideHas) {
    Random random(2);
    for (int trial = 0; trial < 300; ++trial) {
        Baseline baseline;
        std::vector<report::RunSummary> now;
        std::set<std::string> expected;
        for (int name = 0; name < 8; ++name) {
            const std::string text = std::to_string(name);
            const bool isBefore = random.below(2) == 0;
            const bool isNow = random.below(2) == 0;
            if (isBefore) baseline.p50Ms[text] = 1;
            if (isNow) now.push_back(runOf(text, 1));
            if (isBefore != isNow) expected.insert(text);
        }
        const std::vector<std::string> found = notCompared(baseline, now);
        EXPECT_EQ(std::set<std::string>(found.begin(), found.end()), expected);
        EXPECT_EQ(found.size(), expected.size()) << "each once";
    }
}

TEST(Baseline, FailsWhoeverIsSlowerByMoreThanIsAllowed) {
    Random random(3);
    int failed = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        Baseline baseline{"before.json", {}, {}};
        std::vector<report::RunSummary> now;
        const double percent = random.uniform(0, 50);
        bool isSlower = false;
        for (int name = 0; name < 4; ++name) {
            const double before = random.uniform(1, 100);
            const double ratio = random.uniform(0.5, 1.3);
            now.push_back(runOf(std::to_string(name), before * ratio));
            if (random.below(3) == 0) continue; // not in the baseline
            baseline.p50Ms[std::to_string(name)] = before;
            isSlower = isSlower || ratio * 100 > 100 + percent;
        }
        const std::string said = objection([&] { requireNotSlower(baseline, now, percent); });
        EXPECT_EQ(said.empty(), !isSlower && !baseline.p50Ms.empty()) << said;
        failed += isSlower ? 1 : 0;
        if (isSlower) {
            EXPECT_NE(said.find(" became slower: expected a median of at most "), std::string::npos) << said;
        }
    }
    EXPECT_GT(failed, 100);
    EXPECT_EQ(
        objection([] {
            requireNotSlower({"before.json", {}, {{"old", 1}}}, std::vector{runOf("new", 1)}, 5);
        }),
        "before.json: the baseline has none of these runs: expected new, found other names");
}

TEST(Baseline, ComparesWithNoRunThatLackedPages) {
    const Baseline baseline{"before.json", {}, {}};
    report::RunSummary run = runOf("zp4", 1);
    const auto said = [&](bool waits) {
        return objection([&] { requireComplete(baseline, std::vector{runOf("whole", 1), run}, waits); });
    };
    EXPECT_EQ(said(true), "");
    run.pagesMissing = 3;
    EXPECT_EQ(said(false), "") << "in real time pages may be on their way";
    EXPECT_EQ(
        said(true),
        "before.json: zp4 drew without some pages, so its times cannot be compared: expected none damaged and none "
        "missing, found 0 damaged, 3 missing");
    run.pagesDamaged = 2;
    EXPECT_TRUE(said(false).ends_with("found 2 damaged, 0 missing")) << said(false);
}

// A line a run with its change, whether it passes or not; what one side alone has gets none.
TEST(Changes, HaveALineForEachRunOfBothSides) {
    const Baseline baseline{"before.json", {}, {{"warp:none", 10}, {"warp:auto", 20}, {"warp:psm", 5}}};
    report::RunSummary none;
    none.name = "warp:none";
    none.p50Ms = 10.5;
    none.noise = 0.02;
    report::RunSummary automatic = none;
    automatic.name = "warp:auto";
    automatic.p50Ms = 30;
    automatic.noise.reset();
    report::RunSummary other = none;
    other.name = "warp:tsm";
    const std::string pad(52 - automatic.name.size(), ' ');
    EXPECT_EQ(
        changesText(baseline, std::vector{none, automatic, other}, 10),
        "warp:none" + pad + "     10.50 ms,     10.00 before: +5.0%, noise 2.0%, passes: at most +10%\n" + "warp:auto" +
            pad + "     30.00 ms,     20.00 before: +50.0%, FAILS: more than +10%\n");
    EXPECT_NE(
        objection([&] {
            requireNotSlower(baseline, std::vector{none, automatic}, 10);
        }).find("warp:auto"),
        std::string::npos);
}

} // namespace
} // namespace gnomon::bench
