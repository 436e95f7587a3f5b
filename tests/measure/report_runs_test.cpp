// The runs that a report takes where nothing is swept.
#include "measure/report_runs.h"

#include <gtest/gtest.h>

#include <set>

namespace gnomon::measure {
namespace {

TEST(ReportRuns, ContradictNoWarpThatIsAskedFor) {
    settings::ViewOptions warped;
    warped.swept.warp = "lspsm";
    warped.isWarpGiven = true;
    settings::ViewOptions eta;
    eta.eta = "0.5";
    settings::ViewOptions focus;
    focus.swept.warp = "tsm";
    focus.isWarpGiven = true;
    focus.tsmFocus = std::string("2"); // not assigned from a literal: GCC 12 warns of that where it inlines it
    for (const settings::ViewOptions& options : {settings::ViewOptions(), warped, eta, focus})
        for (const bool isQuick : {false, true}) {
            const bool isWarpOpen = options.eta.empty() && options.tsmFocus.empty();
            const std::vector<BenchRun> runs = reportRuns(options.swept, isQuick, isWarpOpen);
            std::set<std::string> names;
            for (const BenchRun& run : runs) {
                EXPECT_NO_THROW(settings::qualityOf(options, run.settings)) << run.options;
                EXPECT_TRUE(names.insert(run.name).second) << run.name;
                EXPECT_TRUE(isWarpOpen || run.settings.warp == options.swept.warp) << run.name;
            }
            EXPECT_GT(runs.size(), 5U);
        }
}

} // namespace
} // namespace gnomon::measure
