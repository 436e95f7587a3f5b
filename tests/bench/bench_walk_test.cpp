// Walks of a bench: what repeats, which caps hold, what real time ends in and what damage does.
#include "bench/bench_walk.h"
#include "core/random.h"
#include "tests/bench/small_bench.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <set>
#include <sstream>

namespace gnomon::bench {
namespace {

path::CameraPath stillness() {
    path::CameraPath path = flight();
    path.keyframes = {path.keyframes[0], path.keyframes[0]};
    path.keyframes[1].time = 0.1;
    return path;
}

TEST(BenchWalk, TwiceTheSameButForTimes) {
    for (const Bytes memory : {gibibytes(1), memoryFor(0.3)}) {
        settings::Settings view = smallSettings();
        view.memory = memory;
        std::vector<std::vector<std::string>> seen;
        for (int i = 0; i < 2; ++i) {
            task::Session session(model(), view, failOnWarning);
            WalkOptions options = frames(12);
            options.repetitions = 2;
            options.warmup = 1;
            seen.push_back(timeless(walked(session, view, flight(), options)));
        }
        EXPECT_EQ(seen[0], seen[1]) << "with --memory " << memory.count;
    }
}

/// Stops after so many steps, as Ctrl-C does.
class StopAfter final : public Progress {
public:
    explicit StopAfter(std::uint64_t steps) : left_(steps) {}

    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t count) override {
        done_ += count;
        if (left_ == 0) throw Interrupted{};
        --left_;
    }

    std::uint64_t done() const { return done_; }

private:
    std::uint64_t left_;
    std::uint64_t done_ = 0;
};

TEST(BenchWalk, TellsPicturesAndProvesFramesOfTheFirstRepetition) {
    std::vector<settings::Settings> swept(2, smallSettings());
    swept[1].quality.zPartitions = 2;
    const std::vector<BenchRun> runs = runsOf(swept);
    const path::CameraPath path = flight();
    WalkOptions options = frames(3);
    options.repetitions = 2;
    options.groundTruth = validation::GroundTruth::SameDetail;
    options.provenFrames = 2;
    std::set<std::pair<std::size_t, int>> told;
    options.onPicture = [&](std::size_t run, int frame, std::span<const std::uint8_t> png) {
        EXPECT_TRUE(told.emplace(run, frame).second);
        EXPECT_FALSE(png.empty());
    };
    task::Session session(model(), smallSettings(), failOnWarning);
    NoProgress progress;
    const std::vector<RunResult> results = walkAlone(session, path, runs, options, progress);
    ASSERT_EQ(results.size(), 2U);
    EXPECT_EQ(told.size(), 6U);
    for (const RunResult& result : results) {
        ASSERT_EQ(result.rows.size(), 6U);
        for (std::size_t row = 0; row < 6; ++row)
            EXPECT_EQ(result.rows[row].wrongShadowFraction.has_value(), row == 0 || row == 2) << row;
        EXPECT_GT(result.cpuMs, 0);
        EXPECT_GT(result.firstFrameMs, 0);
    }
    told.clear();
    options.groundTruth = validation::GroundTruth::None;
    const RunResult again = walkAgain({session, path, runs, options}, 1, progress);
    EXPECT_EQ(again.run.name, runs[1].name);
    EXPECT_EQ(again.rows.size(), 6U);
    EXPECT_TRUE(told.empty());
}

TEST(BenchWalk, CanBeStoppedWhileItWarmsUpAndBetweenPictures) {
    const settings::Settings view = smallSettings();
    task::Session session(model(), view, failOnWarning);
    const std::vector<BenchRun> runs = runsOf({view});
    WalkOptions options = frames(2);
    options.warmup = 3;
    StopAfter third(2);
    EXPECT_THROW(walkAlone(session, flight(), runs, options, third), Interrupted);
    EXPECT_EQ(third.done(), 0U) << "no frame but those before the walk";
    StopAfter never(1000);
    EXPECT_EQ(middlePictures(session, flight(), runs[0], options, never).size(), 6U);
    EXPECT_EQ(never.done(), kFramesOfPictures);
    for (std::uint64_t steps = 0; steps < kFramesOfPictures; ++steps) {
        StopAfter stop(steps);
        EXPECT_THROW(middlePictures(session, flight(), runs[0], options, stop), Interrupted) << steps;
    }
}

TEST(BenchWalk, WaitsUntilTheCutIsThere) {
    const settings::Settings view = smallSettings();
    task::Session session(model(), view, failOnWarning);
    for (const telemetry::FrameRow& row : walked(session, view, flight(), frames(12)).rows) {
        EXPECT_EQ(row.pagesMissing, 0);
        EXPECT_LE(row.achievedErrorPixels, 0.2);
        EXPECT_GT(row.imageTriangles, 0);
    }
}

TEST(BenchWalk, KeepsTheCapOfMemory) {
    for (const bool isRealTime : {false, true}) {
        for (const double fraction : {0.15, 0.4}) {
            settings::Settings view = smallSettings();
            view.memory = memoryFor(fraction);
            task::Session session(model(), view, failOnWarning);
            const std::int64_t tables = static_cast<std::int64_t>(frame::tableBytes(session.model()).count);
            const RunResult result = walked(session, view, flight(), frames(40, isRealTime));
            std::int64_t missing = 0;
            for (const telemetry::FrameRow& row : result.rows) {
                EXPECT_LE(*row.residentBytes + tables, static_cast<std::int64_t>(view.memory.count));
                EXPECT_GT(row.imageTriangles, 0) << "a frame was not drawn";
                EXPECT_EQ(row.achievedErrorPixels > 0.2 && row.pagesMissing == 0, false) << "coarse without saying so";
                missing += *row.pagesMissing;
            }
            EXPECT_FALSE(fraction < 0.2 && missing == 0) << "the cap does not bind: this tests nothing";
        }
    }
}

TEST(BenchWalk, KeepsTheCapOfTriangles) {
    settings::Settings view = smallSettings();
    std::vector<std::int64_t> without;
    {
        task::Session session(model(), view, failOnWarning);
        for (const telemetry::FrameRow& row : walked(session, view, flight(), frames(8)).rows)
            without.push_back(*row.imageTriangles);
    }
    view.quality.maxTriangles = 300;
    int bound = 0;
    task::Session session(model(), view, failOnWarning);
    const RunResult result = walked(session, view, flight(), frames(8));
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
        const telemetry::FrameRow& row = result.rows[i];
        EXPECT_LE(row.imageTriangles, 300);
        EXPECT_GT(row.imageTriangles, 50) << "much less than allowed";
        if (without[i] <= 300) continue;
        ++bound;
        EXPECT_GT(row.achievedErrorPixels, 0.2);
    }
    EXPECT_GT(bound, 4) << "the cap does not bind: this tests nothing";
}

TEST(BenchWalk, StandingStillInRealTimeEndsInWhatWaitingGives) {
    const settings::Settings view = smallSettings();
    task::Session waiting(model(), view, failOnWarning);
    const telemetry::FrameRow right = walked(waiting, view, stillness(), frames(40)).rows.back();
    task::Session session(model(), view, failOnWarning);
    telemetry::FrameRow last;
    for (int attempt = 0; attempt < 50; ++attempt) { // no clock: a slow disk takes more rounds
        last = walked(session, view, stillness(), frames(40, true)).rows.back();
        if (last.imageTriangles == right.imageTriangles) break;
    }
    EXPECT_EQ(last.imageTriangles, right.imageTriangles);
    EXPECT_EQ(last.shadowTriangles, right.shadowTriangles);
    EXPECT_EQ(last.achievedErrorPixels, right.achievedErrorPixels);
    EXPECT_EQ(last.pagesMissing, 0);
    EXPECT_EQ(waiting.backend().picture().pixels, session.backend().picture().pixels);
}

/// A copy of the model with some pages damaged that hold no root.
class DamagedModel {
public:
    DamagedModel(std::uint64_t seed, std::size_t count) : path_(model() + ".damaged") {
        std::filesystem::copy_file(model(), path_, std::filesystem::copy_options::overwrite_existing);
        const hierarchy::ModelFile sound(model());
        std::fstream bytes(path_, std::ios::in | std::ios::out | std::ios::binary);
        Random random(seed);
        std::set<std::size_t> damaged;
        while (damaged.size() < count) {
            const std::size_t id = random.below(sound.pages().size());
            const hierarchy::PageInfo& page = sound.pages()[id];
            const bool isRoot = page.maxError == std::numeric_limits<double>::infinity();
            if (isRoot || !damaged.insert(id).second) continue;
            const auto place = static_cast<std::streamoff>(page.offset + random.below(page.storedBytes));
            bytes.seekg(place);
            const int was = bytes.get();
            bytes.seekp(place);
            bytes.put(static_cast<char>(was ^ 0x10));
        }
    }

    ~DamagedModel() { std::filesystem::remove(path_); }

    DamagedModel(const DamagedModel&) = delete;
    DamagedModel& operator=(const DamagedModel&) = delete;
    DamagedModel(DamagedModel&&) = delete;
    DamagedModel& operator=(DamagedModel&&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string path_;
};

TEST(BenchWalk, DrawsAroundDamageAndNamesItOnce) {
    constexpr std::size_t kDamaged = 50;
    const settings::Settings view = smallSettings();
    task::Session sound(model(), view, failOnWarning);
    const std::vector<telemetry::FrameRow> right = walked(sound, view, flight(), frames(20)).rows;
    for (const bool isRealTime : {false, true}) {
        const DamagedModel damaged(7, kDamaged);
        std::vector<std::string> said;
        task::Session session(damaged.path(), view, [&said](const std::string& line) { said.push_back(line); });
        const RunResult result = walked(session, view, flight(), frames(20, isRealTime));
        for (const std::string& line : said) {
            EXPECT_TRUE(line.starts_with("a page is damaged, coarser pages are drawn instead: ")) << line;
            EXPECT_NE(line.find(damaged.path()), std::string::npos) << line;
        }
        EXPECT_EQ(std::set<std::string>(said.begin(), said.end()).size(), said.size()) << "named twice";
        EXPECT_EQ(static_cast<std::int64_t>(said.size()), result.rows.back().pagesDamaged);
        EXPECT_GT(said.size(), 3U);
        EXPECT_LE(said.size(), kDamaged);
        for (std::size_t i = 0; i < result.rows.size(); ++i) {
            EXPECT_GT(result.rows[i].imageTriangles, 0);
            EXPECT_LE(result.rows[i].imageTriangles, *right[i].imageTriangles + 500);
        }
        const render::PictureDifference difference =
            render::difference(session.backend().picture(), sound.backend().picture());
        EXPECT_LT(difference.changedFraction, 0.5) << "right elsewhere";
    }
}

// What the table of settings says of its rows: all kinds of pictures of the page are the same, however they are drawn.
TEST(BenchWalk, DrawsWhatRunsShowThatDrawAlikeOnce) {
    settings::Settings plain = smallSettings();
    plain.towardsLight = {1, 0.3, 0.2}; // low: the hills throw shadows
    plain.isLightGiven = true;
    settings::Settings unculled = plain;
    unculled.quality.cullCasters = plan::CasterCulling::Off;
    unculled.gpuMemory = mebibytes(64);
    settings::Settings filtered = plain;
    filtered.quality.filter = 3;
    for (const settings::Backend backend : {settings::Backend::Software, settings::Backend::Osmesa}) {
        plain.backend = unculled.backend = filtered.backend = backend;
        const std::vector<BenchRun> runs = runsOf({plain, unculled, filtered});
        NoProgress progress;
        std::vector<report::Picture> apart;
        for (const BenchRun& run : runs) {
            task::Session session(model(), run.settings, failOnWarning);
            for (report::Picture& picture : middlePictures(session, flight(), run, frames(2), progress))
                apart.push_back(std::move(picture));
        }
        task::Session session(model(), plain, failOnWarning);
        const path::CameraPath path = flight();
        const WalkOptions options = frames(2);
        const std::vector<report::Picture> together =
            middlePicturesOfAll({session, path, runs, options}, {0, 1, 2}, progress);
        ASSERT_EQ(together.size(), apart.size());
        for (std::size_t i = 0; i < apart.size(); ++i) {
            EXPECT_EQ(together[i].run, apart[i].run);
            EXPECT_EQ(together[i].kind, apart[i].kind);
            EXPECT_TRUE(together[i].png == apart[i].png) << apart[i].run << " " << apart[i].kind;
        }
        EXPECT_FALSE(together[0].png == together[12].png) << "a filter changes the picture";
    }
}

// The number is of counts alone: twice the runs or repetitions are half the frames, and a small model has all it asks
// for.
TEST(QuickFrames, AreFewerTheMoreThereIsToDraw) {
    settings::Settings large = smallSettings();
    large.imageSize = {1000, 1000};
    task::Session session(model(), large, [](const std::string&) {});
    const auto quick = [&](const settings::Settings& settings, std::size_t runs, int repetitions, int max) {
        WalkOptions options = frames(max);
        options.repetitions = repetitions;
        return quickFrames(session, flight(), runsOf(std::vector(runs, settings)), options);
    };
    EXPECT_EQ(quick(smallSettings(), 1, 1, 8), 8);
    const int once = quick(large, 1, 1, 10000); // 2M for its pixels alone
    EXPECT_GT(once, 300);
    EXPECT_LE(once, static_cast<int>(kQuickWork / 2e6));
    EXPECT_EQ(quick(large, 1, 1, 10000), once);
    EXPECT_NEAR(quick(large, 2, 1, 10000), once / 2.0, 1);
    EXPECT_NEAR(quick(large, 1, 3, 10000), once / 3.0, 1);
    EXPECT_EQ(quick(large, 100, 10, 1000), 1);
}

} // namespace
} // namespace gnomon::bench
