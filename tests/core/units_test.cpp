#include "core/units.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(Units, BytesTakeBinarySuffixes) {
    EXPECT_EQ(parseBytes("2G")->count, 2ULL << 30U);
    EXPECT_EQ(parseBytes("512M")->count, 512ULL << 20U);
    EXPECT_EQ(parseBytes("1.5k")->count, 1536U);
    EXPECT_EQ(parseBytes("17")->count, 17U);
}

TEST(Units, CountsTakeDecimalSuffixes) {
    EXPECT_EQ(parseCount("13M"), 13'000'000U);
    EXPECT_EQ(parseCount("1G"), 1'000'000'000U);
    EXPECT_EQ(parseCount("2.5k"), 2500U);
}

TEST(Units, WhatIsNoNumberIsNothing) {
    for (const char* text : {"", "G", "-1", "1X", "1GB", "nan", "inf", "1e300"}) {
        EXPECT_FALSE(parseBytes(text)) << text;
        EXPECT_FALSE(parseCount(text)) << text;
    }
}

} // namespace
} // namespace gnomon
