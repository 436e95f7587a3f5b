// The generator's sequence is fixed for ever: seeded models and seeded tests rest on it.
#include "core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

namespace gnomon {
namespace {

// Values of the published SplitMix64 with state 1234567 (Steele, Lea, Flood 2014; Vigna's reference code).
TEST(Random, IsTheSplitMix64OfThePaper) {
    Random random(1234567);
    for (const std::uint64_t expected :
         {6457827717110365317ULL,
          3203168211198807973ULL,
          9817491932198370423ULL,
          4593380528125082431ULL,
          16408922859458223821ULL})
        EXPECT_EQ(random.bits(), expected);
}

TEST(Random, UnitsLieInTheHalfOpenIntervalAndFillIt) {
    Random random(1);
    std::array<int, 16> bins{};
    double min = 1;
    double max = 0;
    for (int i = 0; i < 160000; ++i) {
        const double unit = random.unit();
        ASSERT_GE(unit, 0);
        ASSERT_LT(unit, 1);
        min = std::min(min, unit);
        max = std::max(max, unit);
        ++bins.at(static_cast<std::size_t>(unit * 16));
    }
    EXPECT_LT(min, 1e-4);
    EXPECT_GT(max, 1 - 1e-4);
    for (const int count : bins)
        EXPECT_NEAR(count, 10000, 500) << "five standard deviations";
}

TEST(Random, AUniformNumberLiesBetweenItsBounds) {
    Random random(2);
    double sum = 0;
    for (int i = 0; i < 10000; ++i) {
        const double value = random.uniform(-3, 5);
        ASSERT_GE(value, -3);
        ASSERT_LT(value, 5);
        sum += value;
    }
    EXPECT_NEAR(sum / 10000, 1, 0.1);
    EXPECT_EQ(random.uniform(7, 7), 7);
}

TEST(Random, BelowReachesEveryNumberBelowAndNoOther) {
    Random random(3);
    for (const std::uint64_t count : {1U, 2U, 7U, 64U}) {
        std::set<std::uint64_t> seen;
        for (int i = 0; i < 2000; ++i)
            seen.insert(random.below(count));
        EXPECT_EQ(seen.size(), count);
        EXPECT_EQ(*seen.rbegin(), count - 1);
    }
}

TEST(Random, TheMixIsOneToOneOnASampleAndMovesHalfTheBits) {
    std::set<std::uint64_t> images;
    int flipped = 0;
    for (std::uint64_t i = 0; i < 4096; ++i) {
        images.insert(mix64(i));
        flipped += __builtin_popcountll(mix64(i) ^ mix64(i ^ (std::uint64_t{1} << (i % 64))));
    }
    EXPECT_EQ(images.size(), 4096U);
    EXPECT_NEAR(flipped / 4096.0, 32, 1);
}

} // namespace
} // namespace gnomon
