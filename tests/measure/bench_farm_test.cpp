// A bench whose walks are done by several processes comes to what one does, but for times. The processes are sessions
// here; tests/mpi runs real ones.
#include "measure/bench_output.h"
#include "measure/bytes/row_bytes.h"
#include "measure/small_bench.h"

#include <gtest/gtest.h>

#include <map>

namespace gnomon::measure {
namespace {

/// Has every second task done by `other`, and takes results from the last to the first.
class TwoSessions final : public TaskFarm {
public:
    explicit TwoSessions(FarmWork other) : other_(std::move(other)) {}

    bool isLed() const override { return false; }

    void gather(const std::string& /*key*/, const FarmMember& /*self*/, Progress& /*progress*/) override {}

    void serve(const FarmWork& /*work*/, Progress& /*progress*/) override {}

    void run(const FarmTasks& tasks, const FarmWork& work, Progress& progress) override {
        names.push_back(tasks.name);
        const auto tell = [&](const TaskBytes& told) { tasks.hear(told); };
        for (std::size_t task = tasks.count; task-- > 0;) {
            const FarmWork& doer = task % 2 == 0 ? work : other_;
            tasks.take(task, doer.perform(tasks.input(task), progress, tell));
        }
    }

    FarmReport report() const override { return {}; }

    std::vector<std::string> names; // of what was run

private:
    FarmWork other_;
};

/// Counts what progress there is.
class Counted final : public Progress {
public:
    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t count) override { done += count; }

    std::uint64_t done = 0;
};

/// The cells of a run, but for times and for what a process holds of runs that it has walked before.
std::vector<std::string> ofTheRunAlone(RunResult result) {
    for (telemetry::FrameRow& row : result.rows)
        row.residentBytes = row.gpuBytes = row.bytesRead = 0;
    return timeless(result);
}

std::vector<BenchRun> threeRuns() {
    std::vector<settings::Settings> settings(3, smallSettings());
    settings[1].quality.zPartitions = 2;
    settings[2].quality.filter = 3;
    return runsOf(settings);
}

class BenchFarm : public ::testing::Test {
protected:
    BenchFarm() : session(model(), smallSettings(), failOnWarning), other(model(), smallSettings(), failOnWarning) {
        options.repetitions = 2;
        options.warmup = 1;
        options.oracle = proof::Oracle::SameDetail;
        options.provenFrames = 2;
        options.onPicture = [this](std::size_t run, int frame, std::span<const std::uint8_t> png) {
            EXPECT_TRUE(heard.emplace(std::pair(run, frame), std::vector(png.begin(), png.end())).second);
        };
    }

    BenchWalks walks(TaskFarm& farm) { return {session, path, runs, options, farm}; }

    /// Another process of the job: it hands out nothing.
    BenchWalks others() { return {other, path, runs, options, lone}; }

    path::CameraPath path = flight();
    std::vector<BenchRun> runs = threeRuns();
    WalkOptions options = frames(5);
    Session session;
    Session other;
    LoneFarm lone;
    std::map<std::pair<std::size_t, int>, std::vector<std::uint8_t>> heard;
};

TEST_F(BenchFarm, WalksWhatOneProcessWalks) {
    Counted progress;
    const std::vector<RunResult> expected = walkAll(walks(lone), progress);
    EXPECT_EQ(progress.done, frameCount(runs, options));
    const auto heardAlone = std::exchange(heard, {});
    EXPECT_EQ(heardAlone.size(), 15U) << "every frame of each first repetition";
    TwoSessions farm(workOf(others()));
    Counted again;
    const std::vector<RunResult> found = walkAll(walks(farm), again);
    EXPECT_EQ(farm.names, (std::vector<std::string>{"bench", "proof"}));
    EXPECT_EQ(again.done, progress.done);
    EXPECT_TRUE(heard == heardAlone);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t run = 0; run < found.size(); ++run) {
        EXPECT_EQ(found[run].run.name, runs[run].name);
        for (const telemetry::FrameRow& row : found[run].rows)
            EXPECT_EQ(row.run, runs[run].name);
        EXPECT_EQ(ofTheRunAlone(found[run]), ofTheRunAlone(expected[run]));
        EXPECT_GT(found[run].cpuMs, 0);
        EXPECT_GT(found[run].firstFrameMs, 0);
        EXPECT_TRUE(found[run].rows[0].wrongShadowFraction.has_value()) << "it was held against the oracle";
        EXPECT_FALSE(found[run].rows[5].wrongShadowFraction.has_value()) << "in its first repetition alone";
    }
}

TEST_F(BenchFarm, WalksOneRunAgainWithoutPictures) {
    TwoSessions farm(workOf(others()));
    Counted progress;
    const RunResult again = walkAgain(walks(farm), 1, progress);
    EXPECT_EQ(again.run.name, runs[1].name);
    EXPECT_EQ(again.rows.size(), 10U);
    EXPECT_EQ(progress.done, 10U);
    EXPECT_TRUE(heard.empty());
}

TEST_F(BenchFarm, DrawsThePicturesOfOneProcess) {
    Counted progress;
    const auto expected = middlePicturesOfAll(walks(lone), {0, 2}, progress);
    EXPECT_EQ(progress.done, 2 * kFramesOfPictures);
    TwoSessions farm(workOf(others()));
    const auto found = middlePicturesOfAll(walks(farm), {0, 2}, progress);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].run, expected[i].run);
        EXPECT_EQ(found[i].kind, expected[i].kind);
        EXPECT_TRUE(found[i].png == expected[i].png) << i;
    }
}

TEST_F(BenchFarm, KnowsWhoWalksSomethingElse) {
    EXPECT_EQ(keyOf(walks(lone)), keyOf(others()));
    const std::string key = keyOf(walks(lone));
    options.frames = 6;
    EXPECT_NE(keyOf(others()), key);
    options.frames = 5;
    path.keyframes[1].time = 0.3;
    EXPECT_NE(keyOf(others()), key);
    path = flight();
    runs.pop_back();
    EXPECT_NE(keyOf(others()), key);
}

TEST(FarmOfABench, RefusesToShareAHost) {
    FarmReport farm;
    EXPECT_EQ(sharedHost(farm), "");
    farm.members = {
        {.rank = 0, .host = "a", .machine = "x", .threads = 4}, {.rank = 1, .host = "b", .machine = "x", .threads = 4}};
    EXPECT_EQ(sharedHost(farm), "");
    EXPECT_TRUE(unlikeMachines(farm).empty());
    farm.members.push_back({.rank = 2, .host = "a", .machine = "x", .threads = 2});
    EXPECT_EQ(sharedHost(farm), "ranks 0 and 2 are both on a");
    ASSERT_EQ(unlikeMachines(farm).size(), 1U);
    EXPECT_NE(unlikeMachines(farm)[0].find("rank 2 on a has 2 threads of x"), std::string::npos);
}

TEST(RowBytes, ComeBackOrAreRefused) {
    telemetry::FrameRow row;
    row.run = "a run, \"quoted\"";
    row.frame = -5;
    row.timeS = 0.1;
    row.stabilize = true;
    row.totalMs = 1e-300;
    row.promiseKept = false;
    row.occlusion = "off";
    hierarchy::ByteWriter out;
    putRows(out, {row, telemetry::FrameRow()});
    hierarchy::ByteReader in(out.bytes());
    const std::vector<telemetry::FrameRow> back = takeRows(in);
    in.expectEnd();
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(telemetry::jsonObject(back[0]), telemetry::jsonObject(row));
    EXPECT_EQ(telemetry::jsonObject(back[1]), telemetry::jsonObject({}));
    for (std::size_t size = 0; size < out.size(); ++size) {
        hierarchy::ByteReader shorter(std::span(out.bytes()).first(size));
        EXPECT_THROW(takeRows(shorter), hierarchy::Damage) << size;
    }
}

} // namespace
} // namespace gnomon::measure
