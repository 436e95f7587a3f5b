// The gates of a bench: each is made to fail, and random result sets are judged by a slow twin.
#include "bench/gates.h"
#include "bench/verdict_text.h"
#include "core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <nlohmann/json.hpp>

namespace gnomon::bench {
namespace {

/// A result set of one run with `repetitions` steady repetitions of ten frames.
ResultSet setOf(Random& random, int repetitions, double factor = 1) {
    ResultSet set;
    set.path = "before.json";
    set.context = {{"cpu", "one"}, {"library_build_type", "release"}, {"frames", "10"}};
    RunRecord run;
    run.name = run.label = "model/path/maps/8x8/1px/software";
    for (int r = 0; r < repetitions; ++r) {
        std::vector<double> times;
        times.reserve(10);
        for (int frame = 0; frame < 10; ++frame)
            times.push_back(factor * (5 + frame) * random.uniform(0.995, 1.005));
        run.realMs.push_back(times);
        run.cpuMs.push_back(times);
        run.process[kFirstPicture].push_back(factor * 100 * random.uniform(0.99, 1.01));
        run.process[kPeakMemory].push_back(1e8);
    }
    run.work = {{"triangles", 1000}, {"pages", 10}};
    run.errors = {{"promised_aliasing", 2}, {"wrong_pixels_all", 0.01}, {"image_difference", 0.1}};
    set.runs.push_back(run);
    return set;
}

std::vector<std::string> failing(const Verdict& verdict) {
    std::vector<std::string> names;
    for (const Gate& gate : verdict.gates)
        if (gate.fails) names.push_back(gate.quantity);
    return names;
}

/// The verdict after `change` of the second set.
template <class Change>
Verdict verdictAfter(const Change& change, const Limits& limits = {}) {
    Random random(1);
    const ResultSet before = setOf(random, 9);
    ResultSet after = setOf(random, 9);
    change(after.runs.front());
    return judge(before, after, limits);
}

void slowDown(RunRecord& run, double factor) {
    for (Times* times : {&run.realMs, &run.cpuMs})
        for (auto& repetition : *times)
            for (double& time : repetition)
                time *= factor;
}

using Names = std::vector<std::string>;

TEST(Gates, PassTheSameResults) {
    const Verdict verdict = verdictAfter([](RunRecord&) {});
    EXPECT_EQ(verdict.exitCode(), 0) << verdictText(verdict);
    EXPECT_EQ(failureLine(verdict), "");
    EXPECT_EQ(verdict.gates.size(), 10U);
}

TEST(Gates, OfTimeFailWithThree) {
    const Verdict median = verdictAfter([](RunRecord& run) { slowDown(run, 1.2); });
    EXPECT_EQ(failing(median), Names{"median"});
    EXPECT_EQ(median.exitCode(), kSlower);
    const Verdict all = verdictAfter([](RunRecord& run) { slowDown(run, 1.5); });
    EXPECT_EQ(failing(all), (Names{"median", "99th percentile"}));
    const Verdict slow = verdictAfter([](RunRecord& run) {
        for (auto& repetition : run.realMs)
            repetition[3] *= 5;
    });
    EXPECT_EQ(failing(slow), (Names{"99th percentile", "share of frames above twice the median"}));
    const Verdict first = verdictAfter([](RunRecord& run) {
        for (double& value : run.process[kFirstPicture])
            value *= 1.5;
    });
    EXPECT_EQ(failing(first), Names{"time to the first picture"});
    const Verdict memory = verdictAfter([](RunRecord& run) {
        for (double& value : run.process[kPeakMemory])
            value *= 1.2;
    });
    EXPECT_EQ(failing(memory), Names{"peak memory"});
    EXPECT_EQ(memory.exitCode(), kSlower);
}

// A bench without --oracle must not pass where the earlier one had it.
TEST(Gates, FailWithFiveIfAMeasurementIsMissing) {
    const Verdict noError = verdictAfter([](RunRecord& run) { run.errors.erase("wrong_pixels_all"); });
    EXPECT_EQ(failing(noError), Names{"wrong pixels"});
    EXPECT_EQ(noError.exitCode(), kNotComparable);
    const Verdict noCounter = verdictAfter([](RunRecord& run) { run.work.erase("pages"); });
    EXPECT_EQ(failing(noCounter), Names{"pages"});
    EXPECT_EQ(noCounter.exitCode(), kNotComparable);
    const Verdict noBound = verdictAfter([](RunRecord& run) { run.errors.erase("promised_aliasing"); });
    EXPECT_EQ(noBound.exitCode(), 0);
    EXPECT_FALSE(noBound.notes.empty());
}

TEST(Gates, OfAccuracyAndWorkFailWithFour) {
    for (const auto& [key, name] :
         {std::pair{"promised_aliasing", "aliasing bound"},
          std::pair{"wrong_pixels_all", "wrong pixels"},
          std::pair{"image_difference", "image difference"}}) {
        const Verdict verdict = verdictAfter([&, &changed = key](RunRecord& run) { run.errors[changed] *= 1.01; });
        EXPECT_EQ(failing(verdict), Names{name});
        EXPECT_EQ(verdict.exitCode(), kWorse);
    }
    const Verdict work = verdictAfter([](RunRecord& run) { run.work["triangles"] += 1; });
    EXPECT_EQ(failing(work), Names{"triangles"});
    EXPECT_EQ(work.exitCode(), kWorse);
    Limits limits;
    limits.workAbovePercent = 10;
    limits.workAbove["pages"] = 0;
    const auto tenth = [](RunRecord& run) {
        run.work["triangles"] *= 1.09;
        run.work["pages"] += 1;
    };
    EXPECT_EQ(failing(verdictAfter(tenth, limits)), Names{"pages"});
    const Verdict trade = verdictAfter([](RunRecord& run) {
        run.work["triangles"] *= 2;
        run.errors["wrong_pixels_all"] /= 2;
    });
    EXPECT_EQ(trade.exitCode(), kWorse);
    EXPECT_NE(verdictText(trade).find("more accurate and more work"), std::string::npos);
}

TEST(Gates, OfComparabilityFailWithFiveAndAllAreListed) {
    Random random(2);
    const ResultSet before = setOf(random, 9);
    ResultSet after = setOf(random, 9, 2);
    after.runs.front().errors["wrong_pixels_all"] = 0.5;
    after.runs.push_back(after.runs.front());
    after.runs.back().name = "another";
    const Verdict verdict = judge(before, after, {});
    EXPECT_EQ(verdict.exitCode(), kNotComparable);
    const std::vector<std::string> names = failing(verdict);
    for (const char* name : {"run", "wrong pixels", "median"})
        EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
    EXPECT_EQ(judge(after, before, {}).exitCode(), kNotComparable) << "a run of the baseline is missing now";
    for (const bool isDamaged : {false, true}) {
        const Verdict pages =
            verdictAfter([&](RunRecord& run) { (isDamaged ? run.pagesDamaged : run.pagesMissing) = 1; });
        EXPECT_EQ(failing(pages), Names{"pages"});
        EXPECT_EQ(pages.exitCode(), kNotComparable);
    }
    Limits noWait;
    noWait.waits = false;
    EXPECT_EQ(verdictAfter([](RunRecord& run) { run.pagesMissing = 1; }, noWait).exitCode(), 0);
}

TEST(Gates, CompareTheContext) {
    Random random(3);
    const ResultSet before = setOf(random, 1);
    Limits limits;
    limits.alikeKeys = {"frames", "model_content_hash"};
    EXPECT_TRUE(contextGates(before, before.context, limits).empty());
    for (const char* key : {"frames", "cpu", "library_build_type", "model_content_hash"}) {
        auto now = before.context;
        now[key] = "other";
        const std::vector<Gate> gates = contextGates(before, now, limits);
        ASSERT_EQ(gates.size(), 1U) << key;
        EXPECT_EQ(gates.front().quantity, key);
        EXPECT_TRUE(gates.front().fails);
    }
    auto now = before.context;
    now["cpu"] = "other";
    limits.allowsOtherMachine = true;
    EXPECT_TRUE(contextGates(before, now, limits).empty());
}

TEST(Gates, ThatAreUndecidedFailOnlyIfAsked) {
    Random random(4);
    const ResultSet before = setOf(random, 1);
    const ResultSet after = setOf(random, 1, 1.15);
    Limits limits;
    const Verdict passes = judge(before, after, limits);
    EXPECT_EQ(passes.exitCode(), 0);
    const auto median = std::find_if(
        passes.gates.begin(), passes.gates.end(), [](const Gate& gate) { return gate.quantity == "median"; });
    EXPECT_EQ(median->decision, Decision::Undecided);
    EXPECT_GT(median->detectablePercent.value_or(0), limits.failAbovePercent);
    EXPECT_EQ(nlohmann::json::parse(verdictJson(passes)).at("verdict"), "undecided");
    limits.undecided = Decision::Fail;
    EXPECT_EQ(judge(before, after, limits).exitCode(), kSlower);
}

TEST(Gates, UseProcessorTimeWhereWallTimeIsUndecided) {
    Random random(5);
    const auto noisy = [&](RunRecord& run) {
        for (auto& repetition : run.realMs) {
            const double factor = std::exp(random.uniform(-2, 2));
            for (double& time : repetition)
                time *= factor;
        }
    };
    for (const double factor : {1.0, 1.5}) {
        const Verdict verdict = verdictAfter([&](RunRecord& run) {
            slowDown(run, factor);
            noisy(run);
        });
        const auto median = std::find_if(
            verdict.gates.begin(), verdict.gates.end(), [](const Gate& gate) { return gate.quantity == "median"; });
        EXPECT_EQ(median->decision, factor > 1 ? Decision::Fail : Decision::Pass);
        EXPECT_NE(median->note.find("processor time"), std::string::npos);
    }
}

TEST(Gates, OfAnEarlierFileCompareOnlyTimesAndSaySo) {
    ResultSet before;
    before.path = "old.json";
    before.hasOnlyTimes = true;
    RunRecord old;
    old.name = old.label = "run";
    old.realMs = {{10}};
    before.runs.push_back(old);
    Random random(6);
    ResultSet after = setOf(random, 3, 10);
    after.runs.front().label = "run";
    const Verdict verdict = judge(before, after, {});
    EXPECT_EQ(failing(verdict), Names{"median"});
    EXPECT_EQ(verdict.gates.size(), 1U);
    ASSERT_FALSE(verdict.notes.empty());
    EXPECT_NE(verdict.notes.front().find("only times are compared"), std::string::npos);
}

TEST(Gates, SayThatLayoutCanCauseASmallDifference) {
    const Verdict verdict = verdictAfter([](RunRecord& run) { slowDown(run, 1.015); });
    EXPECT_NE(verdictText(verdict).find("Code layout alone"), std::string::npos);
    EXPECT_EQ(
        verdictText(verdictAfter([](RunRecord& run) { slowDown(run, 1.05); })).find("Code layout alone"),
        std::string::npos);
}

/// Checks that `line` and the JSON of `verdict` contain each failing gate.
void expectFailuresListed(const Verdict& verdict, const std::string& line, int code) {
    const auto document = nlohmann::json::parse(verdictJson(verdict));
    EXPECT_EQ(document.at("exit_code"), code);
    std::size_t fails = 0;
    for (const auto& gate : document.at("gates")) {
        if (!gate.at("fails").get<bool>()) continue;
        ++fails;
        EXPECT_NE(line.find(gate.at("quantity").get<std::string>()), std::string::npos);
    }
    EXPECT_EQ(fails > 0, code > 0);
    EXPECT_EQ(line.find('\n'), std::string::npos);
}

// Random sets of several runs: the code is the max over all gates, and each failing gate is in the line and the JSON.
TEST(RandomGates, AgreeWithASlowTwin) {
    Random random(7);
    std::set<int> codes;
    for (int trial = 0; trial < 300; ++trial) {
        ResultSet before = setOf(random, 3);
        ResultSet after = setOf(random, 3);
        RunRecord& run = after.runs.front();
        const bool isSlow = random.below(3) == 0;
        const bool isWrong = random.below(3) == 0;
        const bool isMore = random.below(3) == 0;
        const bool isMissing = random.below(4) == 0;
        if (isSlow) slowDown(run, 4);
        if (isWrong) run.errors["wrong_pixels_all"] *= random.uniform(1.001, 3);
        if (isMore) run.work["triangles"] += 1 + static_cast<double>(random.below(100));
        if (isMissing) before.runs.push_back({"gone", "gone", {{1}}, {}, {}, {}, {}, {}, 0, 0});
        const Verdict verdict = judge(before, after, {});
        const int expected = isMissing ? 5 : isWrong || isMore ? 4 : isSlow ? 3 : 0;
        ASSERT_EQ(verdict.exitCode(), expected) << verdictText(verdict);
        codes.insert(expected);
        expectFailuresListed(verdict, failureLine(verdict), expected);
    }
    EXPECT_EQ(codes, (std::set<int>{0, 3, 4, 5}));
}

} // namespace
} // namespace gnomon::bench
