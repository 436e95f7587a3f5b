// What the view and quality options make of each other.
#include "app/report_runs.h"
#include "app/view_options.h"

#include <gtest/gtest.h>

#include <set>

namespace gnomon::app {
namespace {

TEST(ViewOptions, TheRunsOfAReportContradictNoWarpThatIsAskedFor) {
    ViewOptions warped;
    warped.swept.warp = "lspsm";
    warped.isWarpGiven = true;
    ViewOptions eta;
    eta.eta = "0.5";
    ViewOptions focus;
    focus.swept.warp = "tsm";
    focus.isWarpGiven = true;
    focus.tsmFocus = "2";
    for (const ViewOptions& options : {ViewOptions(), warped, eta, focus})
        for (const bool isQuick : {false, true}) {
            const bool isWarpOpen = options.eta.empty() && options.tsmFocus.empty();
            const std::vector<BenchRun> runs = reportRuns(options.swept, isQuick, isWarpOpen);
            std::set<std::string> names;
            for (const BenchRun& run : runs) {
                EXPECT_NO_THROW(qualityOf(options, run.settings)) << run.options;
                EXPECT_TRUE(names.insert(run.name).second) << run.name;
                EXPECT_TRUE(isWarpOpen || run.settings.warp == options.swept.warp) << run.name;
            }
            EXPECT_GT(runs.size(), 5U);
        }
}

} // namespace
} // namespace gnomon::app
