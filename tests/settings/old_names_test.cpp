// Old names of options mean the new ones, wherever settings are read by name.
#include "settings/old_names.h"
#include "settings/resolve.h"
#include "settings/table.h"
#include "settings/usage_error.h"

#include <gtest/gtest.h>

namespace gnomon::settings {
namespace {

TEST(OldNames, AreReplacedByTheCurrentName) {
    EXPECT_EQ(currentName("near"), "shadow-near");
    EXPECT_EQ(currentName("far"), "shadow-far");
    EXPECT_EQ(currentName("ecef"), "geodetic");
    EXPECT_EQ(currentName("real-time"), "no-wait");
    EXPECT_EQ(currentName("near-floor"), "near-floor");
    EXPECT_EQ(withOldNames("--geodetic"), "--geodetic,--ecef");
    EXPECT_EQ(withOldNames("--near-floor"), "--near-floor");
}

TEST(OldNames, AreReadAsSettings) {
    const Settings settings = settingsOf({{"near", "2"}, {"far", "30"}});
    EXPECT_EQ(settings.quality.near, 2);
    EXPECT_EQ(settings.quality.far, 30);
    for (const Setting& each : table())
        EXPECT_EQ(currentName(each.name()), each.name()) << "the table has current names only";
}

TEST(OldNames, ContradictTheNewName) {
    try {
        settingsOf({{"near", "2"}, {"shadow-near", "3"}});
        ADD_FAILURE();
    } catch (const UsageError& error) {
        EXPECT_EQ(error.option, "--shadow-near");
        EXPECT_EQ(error.message, "--shadow-near: given twice, also by its old name");
    }
}

} // namespace
} // namespace gnomon::settings
