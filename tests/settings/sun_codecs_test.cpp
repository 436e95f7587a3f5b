#include "settings/sun_codecs.h"

#include <gtest/gtest.h>

namespace gnomon::settings {
namespace {

TEST(PlaceCodec, ReadsLatitudeAndLongitudeAndWritesThemBack) {
    const auto found = place().read("39.742476,-105.1786");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->latitude, 39.742476);
    EXPECT_EQ(found->longitude, -105.1786);
    EXPECT_EQ(place().write(*found), "39.742476,-105.1786");
    for (const char* text :
         {"", "1", "1,", ",1", "91,0", "-90.1,0", "0,181", "0,-180.5", "1,2,3", "a,b", "nan,0", "1 ,2"})
        EXPECT_FALSE(place().read(text)) << text;
}

TEST(MomentCodec, WritesWhatItReads) {
    const auto found = moment().read("2026-06-21T12:00+02:00");
    ASSERT_TRUE(found);
    EXPECT_EQ(moment().write(*found), "2026-06-21T12:00:00+02:00");
    EXPECT_FALSE(moment().read("2026-06-21 12:00"));
}

} // namespace
} // namespace gnomon::settings
