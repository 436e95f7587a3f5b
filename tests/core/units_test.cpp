#include "core/units.h"

#include <gtest/gtest.h>

#include <string>

namespace gnomon {
namespace {

TEST(Units, BytesTakeBinarySuffixes) {
    EXPECT_EQ(parseBytes("2G")->count, 2ULL << 30U);
    EXPECT_EQ(parseBytes("512M")->count, 512ULL << 20U);
    EXPECT_EQ(parseBytes("1.5k")->count, 1536U);
    EXPECT_EQ(parseBytes("17")->count, 17U);
    EXPECT_EQ(parseBytes("17B")->count, 17U);
    for (const std::string letter : {"k", "K", "M", "G", "T"})
        for (const char* end : {"B", "iB"})
            EXPECT_EQ(parseBytes("1.5" + letter + end)->count, parseBytes("1.5" + letter)->count) << letter << end;
    for (const char* text : {"B", "iB", "2iB", "2Gi", "2GBB", "2GiBB", "2Gb", "2 GB", "GB", "-1GB"})
        EXPECT_FALSE(parseBytes(text)) << text;
}

TEST(Units, CountsTakeDecimalSuffixes) {
    EXPECT_EQ(parseCount("13M"), 13'000'000U);
    EXPECT_EQ(parseCount("1G"), 1'000'000'000U);
    EXPECT_EQ(parseCount("2.5k"), 2500U);
    EXPECT_FALSE(parseCount("2GB")) << "a size is no count";
}

TEST(Units, WhatIsNoNumberIsNothing) {
    for (const char* text : {"", "G", "-1", "1X", "1GiX", "nan", "inf", "1e300"}) {
        EXPECT_FALSE(parseBytes(text)) << text;
        EXPECT_FALSE(parseCount(text)) << text;
    }
}

} // namespace
} // namespace gnomon
