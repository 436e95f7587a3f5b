// Words that no longer exist are refused with their replacement, wherever a setting is read.
#include "settings/axes.h"
#include "settings/removed_words.h"
#include "settings/resolve.h"
#include "settings/table.h"

#include <gtest/gtest.h>

namespace gnomon::settings {
namespace {

template <class Do>
std::string objection(const Do& action) {
    try {
        action();
        return {};
    } catch (const UsageError& error) {
        return error.message;
    }
}

const std::string kFitted =
    "--warp fitted is removed: use --warp log, which keeps its aliasing bound in the whole frustum";

TEST(RemovedWords, NameTheirReplacement) {
    EXPECT_EQ(objection([] { named("warp").parse("fitted"); }), kFitted);
    EXPECT_EQ(objection([] { parseAxis(named("warp"), "--warp", "log,fitted"); }), kFitted);
    EXPECT_EQ(objection([] { settingsOf({{"warp", "fitted"}}, true); }), kFitted);
    EXPECT_EQ(objection([] { named("warp").parse("log"); }), "");
    const std::string localTmp = "--local-tmp is removed: all temporary files of a build are in --tmp";
    EXPECT_EQ(objection([] { refuseRemovedOption("--local-tmp"); }), localTmp);
    EXPECT_EQ(objection([] { refuseRemovedOption("--local-tmp=/scratch"); }), localTmp);
    EXPECT_EQ(objection([] { refuseRemovedOption("--warp=fitted"); }), "") << "the option is still there";
    EXPECT_NE(objection([] { named("shadows").parse("fitted"); }).find("found 'fitted'"), std::string::npos);
}

TEST(RemovedWords, AreNoWordsOfATable) {
    for (const Setting& setting : table())
        for (const std::string& word : setting.words())
            EXPECT_EQ(objection([&] { refuseRemovedWord(setting.option(), word); }), "");
}

} // namespace
} // namespace gnomon::settings
