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

TEST(Units, SuffixesAreReadInPowersAndRoundedToWholeNumbers) {
    EXPECT_EQ(parseCount("1k"), 1000U);
    EXPECT_EQ(parseCount("1K"), 1000U);
    EXPECT_EQ(parseCount("1T"), 1'000'000'000'000U);
    EXPECT_EQ(parseCount("0"), 0U);
    EXPECT_EQ(parseCount("2.4"), 2U);
    EXPECT_EQ(parseCount("2.5"), 3U);
    EXPECT_EQ(parseCount("1e3"), 1000U);
    EXPECT_EQ(parseBytes("1T")->count, 1ULL << 40U);
    EXPECT_FALSE(parseCount("9.3e18")) << "as near to 2^63 as a count may be read";
    EXPECT_EQ(parseCount("9.1e18"), 9'100'000'000'000'000'000U);
    EXPECT_FALSE(parseCount("10000000T"));
    EXPECT_EQ(mebibytes(3).count, 3U * 1024 * 1024);
    EXPECT_EQ(gibibytes(3).count, 3ULL * 1024 * 1024 * 1024);
}

TEST(Units, PeopleReadThreeOrFourDigits) {
    EXPECT_EQ(readableBytes({0}), "0 B");
    EXPECT_EQ(readableBytes({1023}), "1023 B");
    EXPECT_EQ(readableBytes({1024}), "1.00 KiB");
    EXPECT_EQ(readableBytes({3ULL << 29U}), "1.50 GiB");
    EXPECT_EQ(readableBytes({2000ULL << 40U}), "2000.00 TiB") << "the largest unit takes what is left";
    EXPECT_EQ(readableCount(999), "999");
    EXPECT_EQ(readableCount(1000), "1.0k");
    EXPECT_EQ(readableCount(13'000'000), "13.0M");
    EXPECT_EQ(readableCount(372'000'000'000), "372.0G");
}

} // namespace
} // namespace gnomon
