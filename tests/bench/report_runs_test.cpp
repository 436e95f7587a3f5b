// The runs of a bench: how they are named, and those that a report takes where nothing is swept.
#include "bench/report_runs.h"
#include "settings/axes.h"
#include "settings/resolve.h"
#include "settings/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace gnomon::bench {
namespace {

TEST(BenchRuns, AreCalledByWhatVaries) {
    const std::array axes = {
        settings::parseAxis(settings::named("error-pixels"), "--error-pixels", "1,2.50"),
        settings::parseAxis(settings::named("warp"), "--warp", "none"),
        settings::parseAxis(settings::named("z-partitions"), "--shadow-maps", "auto,8")};
    settings::Settings fixed;
    fixed.quality.splitLambda = 0.5;
    const std::vector<BenchRun> runs = runsOf(settings::combinations(fixed, axes));
    ASSERT_EQ(runs.size(), 4U);
    EXPECT_EQ(runs[0].name, "error_pixels:1/z_partitions:auto");
    EXPECT_EQ(runs[3].name, "error_pixels:2.5/z_partitions:8");
    EXPECT_EQ(runs[3].options, "--error-pixels 2.5 --warp none --z-partitions 8 --split-lambda 0.5");
    EXPECT_EQ(runsOf({settings::Settings()})[0].name, "run");
    EXPECT_EQ(runsOf({settings::Settings()})[0].options, "");
}

TEST(BenchRuns, DrawExactShadowsOnceForAllNumbersOfMaps) {
    const std::array axes = {
        settings::parseAxis(settings::named("error-pixels"), "--error-pixels", "1,2"),
        settings::parseAxis(settings::named("shadows"), "--shadows", "maps,exact"),
        settings::parseAxis(settings::named("z-partitions"), "--shadow-maps", "1,4,8")};
    std::vector<std::string> names;
    for (const BenchRun& run : runsOf(settings::combinations({}, axes)))
        names.push_back(run.name);
    std::vector<std::string> expected;
    for (const std::string error : {"error_pixels:1/", "error_pixels:2/"}) {
        for (const char* maps : {"1", "4", "8"})
            expected.push_back(error + "shadows:maps/z_partitions:" + maps);
        expected.push_back(error + "shadows:exact");
    }
    EXPECT_EQ(names, expected);
}

TEST(ReportRuns, ContradictNoWarpThatIsAskedFor) {
    settings::Settings warped;
    warped.quality.warp.rule = shadow::WarpRule::Lspsm;
    warped.isWarpGiven = true;
    settings::Settings eta;
    eta.eta = 0.5;
    settings::Settings focus = warped;
    focus.quality.warp.rule = shadow::WarpRule::Tsm;
    focus.tsmFocus = 2;
    for (const settings::Settings& base : {settings::Settings(), warped, eta, focus})
        for (const bool isQuick : {false, true}) {
            const bool isWarpOpen = !base.eta && !base.tsmFocus;
            std::set<std::string> names;
            std::set<plan::CellScheme> cells;
            const std::vector<BenchRun> runs = reportRuns(base, isQuick);
            const bool isExact =
                settings::capabilitiesOf(task::backendFor(base, settings::DrawingCommand::Bench).backend).exactShadows;
            std::size_t exact = 0;
            for (const BenchRun& run : runs) {
                EXPECT_NE(run.settings.quality.shadows, plan::ShadowMode::Auto) << "modes by their names: " << run.name;
                exact += run.settings.quality.shadows == plan::ShadowMode::Exact ? 1U : 0U;
                EXPECT_NO_THROW(settings::qualityOf(run.settings)) << run.options;
                EXPECT_TRUE(names.insert(run.name).second) << run.name;
                const bool hasMaps = run.settings.quality.shadows != plan::ShadowMode::Exact;
                EXPECT_TRUE(isWarpOpen || !hasMaps || run.settings.quality.warp.rule == base.quality.warp.rule)
                    << run.name;
                cells.insert(run.settings.quality.cellScheme);
                EXPECT_TRUE(hasMaps || run.options.find("warp") == std::string::npos) << run.options;
            }
            EXPECT_GT(runs.size(), 5U);
            const auto isLog = [](const BenchRun& run) {
                return run.settings.quality.warp.rule == shadow::WarpRule::Log;
            };
            const auto logarithmic = std::count_if(runs.begin(), runs.end(), isLog);
            EXPECT_EQ(logarithmic, isWarpOpen && isExact ? (isQuick ? 2 : 6) : 0);
            EXPECT_EQ(exact, isExact ? plan::kCellSchemes.size() : 0U);
            EXPECT_EQ(cells.size(), isExact ? plan::kCellSchemes.size() : 1U);
        }
}

} // namespace
} // namespace gnomon::bench
