// What `gnomon path` takes together, and what it refuses.
#include "settings/path_options.h"
#include "settings/usage_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon::settings {
namespace {

TEST(PathOptions, OnlyAWalkHasStoreysAndAnEye) {
    for (const char* kind : {"walk", "orbit", "flyby", "approach", "source"})
        EXPECT_NO_THROW(checkPathOptions({kind, {}}));
    EXPECT_NO_THROW(checkPathOptions({"walk", {0, 0.2}}));
    EXPECT_THROW(checkPathOptions({"orbit", {0, {}}}), UsageError);
    EXPECT_THROW(checkPathOptions({"flyby", {{}, 1.7}}), UsageError);
    EXPECT_THROW(checkPathOptions({"source", {{}, 1.7}}), UsageError);
    EXPECT_THROW(checkPathOptions({"stroll", {}}), UsageError);
}

TEST(PathOptions, StoreysCountFromTheLowestAndEyesAreAboveTheFloor) {
    EXPECT_THROW(checkPathOptions({"walk", {-1, {}}}), UsageError);
    for (const double height : {0.0, -1.7, std::numeric_limits<double>::infinity(), std::nan("")})
        EXPECT_THROW(checkPathOptions({"walk", {{}, height}}), UsageError) << height;
}

} // namespace
} // namespace gnomon::settings
