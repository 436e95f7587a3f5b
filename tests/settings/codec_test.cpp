// How values are written: what is read, what is refused, and that what is written reads back.
#include "settings/codec.h"

#include <gtest/gtest.h>

namespace gnomon::settings {
namespace {

/// What `codec` makes of each of `texts`; "-" where it is refused.
template <class T>
std::string written(const Codec<T>& codec, std::initializer_list<const char*> texts) {
    std::string all;
    for (const char* text : texts) {
        const std::optional<T> value = codec.read(text);
        all += (all.empty() ? "" : " ") + (value ? codec.write(*value) : std::string("-"));
    }
    return all;
}

TEST(Codec, NumbersAreFiniteAndTheShortestThatReadBack) {
    EXPECT_EQ(
        written(anyNumber(), {"1.50", "+2", "-0.1", "1e30", "nan", "inf", "", "1x", " 1"}),
        "1.5 2 -0.1 1e+30 - - - - -");
    EXPECT_EQ(written(positiveNumber(), {"0", "-1", "1e-300"}), "- - 1e-300");
    EXPECT_EQ(written(distance(), {"1e-15", "1e15", "9e-16", "1.1e15"}), "1e-15 1e+15 - -");
    EXPECT_EQ(written(whole(1, 12), {"1", "12", "0", "13", "2.0", "4 "}), "1 12 - - - -");
    EXPECT_EQ(
        written(seed(), {"0", "18446744073709551615", "18446744073709551616", "-1"}), "0 18446744073709551615 - -");
}

TEST(Codec, VectorsAndSizesHaveAllTheirParts) {
    EXPECT_EQ(written(vector(), {"1,2.50,-3", "0,0,0", "1,2", "1,2,3,4", "1,,3", "1,2,nan"}), "1,2.5,-3 0,0,0 - - - -");
    EXPECT_EQ(written(direction(), {"0,0,2", "0,0,0", "1e308,1e308,0"}), "0,0,2 - -");
    const auto small = size("at most 9", [](const std::array<int, 2>& value) { return value[0] * value[1] <= 9; });
    EXPECT_EQ(written(small, {"3x3", "9x1", "2x5", "0x4", "-1x-1", "3", "3x3x1", "3X3"}), "3x3 9x1 - - - - - -");
    EXPECT_EQ(small.expected, "WxH, at most 9");
}

TEST(Codec, CountsAndMemoryKeepTheirSuffix) {
    EXPECT_EQ(written(count(), {"10k", "1500", "2.5k", "13M", "1G", "0", "-3", "many"}), "10k 1500 2500 13M 1G - - -");
    EXPECT_EQ(written(memory(), {"512M", "2G", "1024M", "1000", "1.5M", "0", "x"}), "512M 2G 1G 1000 1536k - -");
}

TEST(Codec, WhatIsAutoOrNotGivenIsNothing) {
    EXPECT_EQ(written(orAuto(whole(1, 4)), {"auto", "3", "5", ""}), "auto 3 - -");
    EXPECT_EQ(orAuto(whole(1, 4)).expected, "auto or a whole number from 1 to 4");
    EXPECT_EQ(ifGiven(positiveNumber()).write(std::nullopt), "");
    EXPECT_EQ(written(ifGiven(positiveNumber()), {"2", "0"}), "2 -");
    EXPECT_EQ(written(onOff(), {"on", "off", "yes", ""}), "on off - -");
}

TEST(Codec, WhoIsRefusedIsToldTheOptionAndWhatItTakes) {
    try {
        parsed(onOff(), "--stabilize", "maybe");
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_EQ(error.message, "--stabilize: expected on or off, found 'maybe'");
    }
    for (const char* list : {"", ",", "1,", ",1", "1,,2"})
        EXPECT_THROW(listItems("--warp", list), UsageError) << list;
    EXPECT_EQ(listItems("--warp", "a,b").size(), 2U);
}

} // namespace
} // namespace gnomon::settings
