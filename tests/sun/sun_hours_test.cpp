// Hours of sun: a period in steps, light after light on one view, and the log that a killed run goes on with.
#include "core/error.h"
#include "core/random.h"
#include "exact/visible_points.h"
#include "settings/sun_period.h"
#include "settings/sun_settings.h"
#include "sun/lit_log.h"
#include "sun/receivers.h"
#include "sun/sun_day.h"
#include "sun/sun_hours.h"
#include "sun/sun_steps.h"
#include "sun/sun_view.h"
#include "tests/sun/box_yard.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <filesystem>
#include <fstream>
#include <set>

namespace gnomon::sun {
namespace {

sun::CivilTime momentAt(const std::string& text) {
    return *sun::parseCivilTime(text);
}

SunPeriod midsummerDay() {
    return {{47, 8}, momentAt("2026-06-21T00:00+02:00"), momentAt("2026-06-22T00:00+02:00"), 900};
}

TEST(SunSteps, StandForTheMiddlesOfTheirPartsOfThePeriod) {
    const std::vector<SunStep> steps = sunSteps(midsummerDay());
    ASSERT_EQ(steps.size(), 96U);
    EXPECT_EQ(steps.front().time, "2026-06-21T00:07:30+02:00");
    EXPECT_EQ(steps.back().time, "2026-06-21T23:52:30+02:00");
    const sun::SunDay day = sun::sunDay(midsummerDay().from, midsummerDay().place, {});
    for (const SunStep& step : steps) {
        const SunPeriod period = midsummerDay();
        const sun::SunPosition sun = sun::sunPosition(sun::julianDate(momentAt(step.time)), period.place, {});
        EXPECT_EQ(step.isUp, sun.elevationRefracted > 0) << step.time;
        if (!step.isUp) continue;
        const glm::dvec3 light = step.light.unit();
        EXPECT_NEAR(std::asin(light.y) * 180 / 3.14159265358979, sun.elevationRefracted, 1e-5) << step.time;
        EXPECT_GT(light.x * (sun.azimuth < 180 ? 1 : -1), 0) << "in the east before noon";
    }
    const double hoursUp =
        24 * ((day.sunset->midnight - day.sunrise->midnight) + day.sunset->fraction - day.sunrise->fraction);
    EXPECT_NEAR(static_cast<double>(lightsOf(steps).size()) / 4, hoursUp, 0.5)
        << "but for half a step and the disc's half at both ends";
}

TEST(SunSteps, TakeAHalfStepMoreOrLessAndRefuseTooFewAndTooMany) {
    SunPeriod period = midsummerDay();
    period.to = momentAt("2026-06-21T01:00+02:00");
    const auto count = [&](double seconds) {
        period.stepSeconds = seconds;
        settings::requireSteps(period);
        return sunSteps(period).size();
    };
    EXPECT_EQ(count(1800), 2U);
    EXPECT_EQ(count(1000), 4U); // 3.6 of them
    EXPECT_EQ(count(1100), 3U); // 3.27
    EXPECT_EQ(count(5400), 1U);
    EXPECT_EQ(count(300), 12U);
    EXPECT_THROW(count(7300), settings::UsageError);
    EXPECT_THROW(count(1e-3), settings::UsageError);
    std::swap(period.from, period.to);
    EXPECT_THROW(count(300), settings::UsageError);
}

/// Which pixels a frame by itself has in the light.
std::vector<std::uint8_t> litByFrame(BoxYard& yard, const IntegerLight& light) {
    plan::View view = yard.view;
    view.towardsLight = glm::dvec3(light.direction);
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Exact;
    frame::FrameOptions options;
    options.wantsSurfaces = true;
    yard.model->draw(view, quality, options);
    std::vector<std::uint8_t> lit;
    for (const render::SurfaceSample& surface : yard.model->backend().surfaces().pixels)
        lit.push_back(surface.isLitSide() && surface.litFraction() >= 0.5F ? 1 : 0);
    return lit;
}

TEST(SunView, LightsWhatFramesAndPlainIntegersDo) {
    std::size_t litPixels = 0;
    std::size_t darkPoints = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        BoxYard yard(seed);
        if (seed > 2) yard.view.sections = {{{0, -1, 0}, 2.5}, {{-0.8, 0, 0.6}, 6}};
        yard.view.cutsCasters = seed == 3;
        std::vector<std::vector<std::uint8_t>> expected;
        for (const IntegerLight& light : yard.lights)
            expected.push_back(litByFrame(yard, light));
        SunView receivers(yard.model->renderer(), yard.view, {}, yard.lights);
        ASSERT_EQ(receivers.count(), expected.front().size());
        std::vector<std::uint8_t> lit(receivers.count(), 7);
        std::vector<std::uint8_t> plain(receivers.count(), 7);
        const std::vector<std::uint8_t> all(receivers.count(), 1);
        for (std::size_t i = 0; i < yard.lights.size(); ++i) {
            const exact::ExactStatistics statistics = receivers.resolve(yard.lights[i], lit);
            receivers.resolvePlainly(yard.lights[i], all, plain);
            EXPECT_EQ(lit, plain) << "seed " << seed << ", light " << i;
            EXPECT_EQ(lit, expected[i]) << "seed " << seed << ", light " << i;
            litPixels += static_cast<std::size_t>(std::count(lit.begin(), lit.end(), 1));
            darkPoints += statistics.dark;
        }
    }
    EXPECT_GT(litPixels, 20000U);
    EXPECT_GT(darkPoints, 5000U);
}

TEST(SunView, HangsOnNoThreadsAndNoLightBefore) {
    BoxYard yard(9);
    std::vector<std::vector<std::uint8_t>> before;
    for (const int threads : {1, 2, 4})
        tbb::task_arena(threads).execute([&] {
            SunView receivers(yard.model->renderer(), yard.view, {}, yard.lights);
            std::vector<std::vector<std::uint8_t>> lit(
                yard.lights.size(), std::vector<std::uint8_t>(receivers.count()));
            for (std::size_t i = 0; i < lit.size(); ++i) {
                const std::size_t at = threads == 2 ? lit.size() - 1 - i : i;
                receivers.resolve(yard.lights[at], lit[at]);
            }
            if (before.empty()) before = lit;
            EXPECT_EQ(lit, before) << threads << " threads";
        });
}

TEST(SunView, SaysWhereItsPointsLie) {
    BoxYard yard(3);
    const SunView receivers(yard.model->renderer(), yard.view, {}, yard.lights);
    const CameraBasis basis = cameraBasis(yard.view.camera);
    ASSERT_GT(receivers.points().size(), 1000U);
    for (std::size_t i = 0; i < receivers.points().size(); ++i) {
        const glm::dvec3 d = receivers.position(i) - yard.view.camera.eye;
        const double depth = glm::dot(d, basis.view);
        const std::uint32_t pixel = receivers.points().pixel(i);
        const double x = (glm::dot(d, basis.right) / depth / yard.view.tanHalfX() + 1) / 2 * yard.view.width;
        const double y = (1 - glm::dot(d, basis.up) / depth / yard.view.tanHalfY()) / 2 * yard.view.height;
        EXPECT_NEAR(x, pixel % 120 + 0.5, 0.01);
        EXPECT_NEAR(y, static_cast<int>(pixel / 120) + 0.5, 0.01);
    }
}

/// Receivers that light of a given direction reaches or not, by chance.
class Dice final : public Receivers {
public:
    std::size_t count() const override { return 1000; }

    exact::ExactStatistics resolve(const IntegerLight& light, std::span<std::uint8_t> isLit) override {
        ++decided;
        for (std::size_t i = 0; i < isLit.size(); ++i)
            isLit[i] = mix64(i ^ mix64(static_cast<std::uint64_t>(light.direction.x))) % 3 == 0 ? 1 : 0;
        exact::ExactStatistics statistics;
        statistics.samples = isLit.size();
        return statistics;
    }

    std::size_t decided = 0;
};

/// Ends the work after so many lights.
class Stopping final : public Progress {
public:
    explicit Stopping(std::uint64_t after) : left_(after) {}

    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t count) override {
        if (left_ <= count) throw Interrupted{};
        left_ -= count;
    }

private:
    std::uint64_t left_;
};

/// A name for the logs of a run, which go with it.
struct LogName {
    LogName() { std::filesystem::create_directory(folder); }

    ~LogName() { std::filesystem::remove_all(folder); }

    LogName(const LogName&) = delete;
    LogName& operator=(const LogName&) = delete;
    LogName(LogName&&) = delete;
    LogName& operator=(LogName&&) = delete;

    /// The files that are there.
    std::set<std::string> left() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            names.insert(entry.path().filename().string());
        return names;
    }

    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("gnomon_sun_log_" + std::to_string(::getpid()));
    std::string stem = (folder / "h.png").string();
    std::string path = stem + ".steps"; // of rank 0
};

constexpr LightShare kAll;

LitLogs logsOf(const LogName& name, bool isResumed, const LightShare& share = kAll, const std::string& key = "a") {
    return {name.stem, key, Dice().count(), share, isResumed};
}

void expectSame(const LitSteps& found, const LitSteps& expected) {
    EXPECT_EQ(found.count, expected.count);
    EXPECT_EQ(found.first, expected.first);
    EXPECT_EQ(found.last, expected.last);
    EXPECT_EQ(found.stepsUp, expected.stepsUp);
}

TEST(LitSteps, CountEachStepAndKeepTheFirstAndTheLast) {
    const std::vector<SunStep> steps = sunSteps(midsummerDay());
    const LogName name;
    LitLogs logs = logsOf(name, false);
    Dice dice;
    NoProgress silent;
    const LitSteps found = litSteps(dice, steps, logs, kAll, silent);
    EXPECT_EQ(found.samples, 1000U * found.stepsUp);
    std::vector<std::uint8_t> lit(dice.count());
    LitSteps expected;
    expected.count.assign(dice.count(), 0);
    expected.first = expected.last = std::vector<std::uint32_t>(dice.count(), LitSteps::kNever);
    expected.stepsUp = static_cast<std::uint32_t>(lightsOf(steps).size());
    for (std::uint32_t s = 0; s < steps.size(); ++s) {
        if (!steps[s].isUp) continue;
        dice.resolve(steps[s].light, lit);
        for (std::size_t i = 0; i < lit.size(); ++i) {
            expected.count[i] += lit[i];
            if (lit[i] != 0 && expected.first[i] == LitSteps::kNever) expected.first[i] = s;
            if (lit[i] != 0) expected.last[i] = s;
        }
    }
    expectSame(found, expected);
    logs.remove();
    EXPECT_TRUE(name.left().empty());
}

/// What comes of a run that nobody stops.
LitSteps undisturbed(const std::vector<SunStep>& steps, const LogName& name) {
    Dice dice;
    NoProgress silent;
    LitLogs logs = logsOf(name, false);
    LitSteps whole = litSteps(dice, steps, logs, kAll, silent);
    logs.remove();
    return whole;
}

/// The sum of what ranks came to, as a job reduces it.
LitSteps reduced(const std::vector<LitSteps>& ranks) {
    LitSteps sum = ranks.front();
    for (std::size_t rank = 1; rank < ranks.size(); ++rank)
        for (std::size_t i = 0; i < sum.count.size(); ++i) {
            sum.count[i] += ranks[rank].count[i];
            sum.first[i] = std::min(sum.first[i], ranks[rank].first[i]);
            sum.last[i] = std::max(sum.last[i] + 1, ranks[rank].last[i] + 1) - 1;
        }
    return sum;
}

TEST(LitSteps, GoOnWhereAKilledRunStopped) {
    const std::vector<SunStep> steps = sunSteps(midsummerDay());
    const std::size_t lights = lightsOf(steps).size();
    const LogName name;
    Dice dice;
    NoProgress silent;
    const LitSteps whole = undisturbed(steps, name);
    for (const int cut : {0, 1, 50, 136}) { // bytes that a kill leaves of a record more
        Stopping stopping(20);
        {
            LitLogs logs = logsOf(name, false);
            EXPECT_THROW(litSteps(dice, steps, logs, kAll, stopping), Interrupted);
        }
        std::ofstream(name.path, std::ios::app | std::ios::binary) << std::string(static_cast<std::size_t>(cut), 'x');
        EXPECT_THROW(logsOf(name, true, kAll, "b"), Error);
        LitLogs logs = logsOf(name, true);
        EXPECT_THROW(logsOf(name, true), Error) << "one process at a time";
        dice.decided = 0;
        const LitSteps resumed = litSteps(dice, steps, logs, kAll, silent);
        EXPECT_EQ(dice.decided, lights - 20);
        EXPECT_EQ(resumed.samples, 1000U * (lights - 20)) << "of those that were decided now";
        expectSame(resumed, whole);
        logs.remove();
    }
}

TEST(LitSteps, OfRanksAddUpAndAreResumedByAnyNumberOfThem) {
    const std::vector<SunStep> steps = sunSteps(midsummerDay());
    const std::size_t lights = lightsOf(steps).size();
    const LogName name;
    Dice dice;
    NoProgress silent;
    const LitSteps whole = undisturbed(steps, name);
    const auto run = [&](std::uint32_t ranks, bool isResumed) {
        std::vector<LitSteps> parts;
        for (std::uint32_t rank = 0; rank < ranks; ++rank) {
            LitLogs logs = logsOf(name, isResumed, {rank, ranks});
            parts.push_back(litSteps(dice, steps, logs, {rank, ranks}, silent));
        }
        return reduced(parts);
    };
    expectSame(run(3, false), whole);
    EXPECT_EQ(name.left(), (std::set<std::string>{"h.png.steps", "h.png.1.steps", "h.png.2.steps"}));
    for (std::uint32_t rank = 0; rank < 3; ++rank) { // killed after a few lights each
        Stopping stopping(5 + rank);
        LitLogs logs = logsOf(name, false, {rank, 3});
        EXPECT_THROW(litSteps(dice, steps, logs, {rank, 3}, stopping), Interrupted);
    }
    for (const std::uint32_t ranks : {2U, 1U, 4U}) {
        dice.decided = 0;
        expectSame(run(ranks, true), whole);
        EXPECT_EQ(dice.decided, ranks == 2 ? lights - 18 : 0) << "the first resume decides the rest";
    }
    std::ofstream(name.folder / "h.png.7.steps") << "a text of some length that is nobody's log";
    LitLogs logs = logsOf(name, true);
    std::vector<std::uint8_t> lit;
    std::vector<std::uint8_t> expected(dice.count());
    for (std::size_t light = 0; light < lights; ++light) {
        EXPECT_TRUE(logs.read(light, lit));
        dice.resolve(lightsOf(steps)[light], expected);
        EXPECT_EQ(lit, expected) << light;
    }
    EXPECT_FALSE(logs.read(lights, lit));
    logs.remove();
    EXPECT_EQ(name.left(), (std::set<std::string>{"h.png.7.steps"})) << "it is no log";
}

TEST(LitLogs, OfARunThatIsNotResumedBeginAnew) {
    const LogName name;
    const std::vector<std::uint8_t> isLit(Dice().count(), 1);
    std::vector<std::uint8_t> read;
    for (const std::uint32_t rank : {0U, 1U, 2U})
        logsOf(name, false, {rank, 3}).put(rank, isLit);
    LitLogs logs = logsOf(name, false, {0, 2});
    EXPECT_EQ(name.left(), (std::set<std::string>{"h.png.steps", "h.png.1.steps"})) << "there is no rank 2 now";
    for (const std::size_t light : {0U, 1U, 2U})
        EXPECT_FALSE(logs.read(light, read));
}

TEST(LitLog, BeginsAnewAfterAKillWithinItsHead) {
    const LogName name;
    const std::string key = "a key of some length";
    const std::vector<std::uint8_t> isLit(64, 1);
    std::vector<std::uint8_t> read;
    LitLog(name.path, key, 64, false).put(0, isLit);
    for (std::uintmax_t bytes = 0; bytes < 2 * sizeof(std::uint64_t) + key.size(); ++bytes) {
        std::filesystem::resize_file(name.path, bytes);
        EXPECT_FALSE(LitLog::ofAnother(name.path, key, 64)) << bytes;
        LitLog log(name.path, key, 64, true);
        EXPECT_FALSE(log.read(0, read)) << bytes;
        log.put(0, isLit);
    }
    EXPECT_TRUE(LitLog(name.path, key, 64, true).read(0, read));
    EXPECT_EQ(read, isLit);
    EXPECT_THROW(LitLog::ofAnother(name.path, "another", 64), Error);
}

TEST(LitLog, ReadsNoRecordBehindTheLastOneThatIsAskedFor) {
    const LogName name;
    const std::vector<std::uint8_t> isLit(64, 1);
    LitLog(name.path, "a", 64, false).put(2, isLit);
    std::filesystem::resize_file(name.path, std::uintmax_t{1} << 40U); // a hole: no test would end that reads it
    const LitLog log(name.path, "a", 64, true);
    std::vector<std::uint8_t> read;
    EXPECT_TRUE(log.read(2, read));
    for (const std::size_t light : {0U, 1U, 3U, 1000000U})
        EXPECT_FALSE(log.read(light, read)) << "zeros are no record";
}

TEST(LitLog, WithAnotherNameIsNotWritten) {
    const LogName name;
    const std::vector<std::uint8_t> isLit(64, 1);
    LitLog(name.path, "a", 64, false).put(0, isLit);
    const std::string other = name.path + ".other";
    std::filesystem::create_hard_link(name.path, other);
    const auto size = std::filesystem::file_size(other);
    EXPECT_THROW(LitLog(name.path, "a", 64, false), Error);
    EXPECT_EQ(std::filesystem::file_size(other), size);
    std::filesystem::remove(other);
    std::vector<std::uint8_t> read;
    EXPECT_TRUE(LitLog(name.path, "a", 64, true).read(0, read));
}

TEST(LitLog, LeavesWhatIsNoLogAlone) {
    const LogName name;
    std::vector<std::uint8_t> read;
    std::ofstream(name.path) << "a text of some length that is nobody's log";
    EXPECT_THROW(LitLog(name.path, "a", 64, true), Error);
    EXPECT_GT(std::filesystem::file_size(name.path), 0U);
    std::filesystem::remove(name.path);
    EXPECT_FALSE(LitLog(name.path, "a", 64, true).read(0, read)) << "nothing to resume is a beginning";
}

} // namespace
} // namespace gnomon::sun
