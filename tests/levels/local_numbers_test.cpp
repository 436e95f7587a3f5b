// Numbers from marks against numbers from a map.
#include "core/random.h"
#include "preprocess/levels/local_numbers.h"

#include <gtest/gtest.h>

#include <map>

namespace gnomon::levels {
namespace {

void expectNumbersOfAMap(LocalNumbers& numbers, std::uint32_t count, Random& random) {
    for (int part = 0; part < 200; ++part) {
        numbers.begin();
        EXPECT_TRUE(numbers.ids().empty());
        std::map<std::uint32_t, std::uint32_t> plain;
        std::vector<std::uint32_t> ids;
        for (std::uint64_t left = random.below(60); left > 0; --left) {
            const auto id = static_cast<std::uint32_t>(random.below(count));
            const auto [found, isNew] = plain.try_emplace(id, static_cast<std::uint32_t>(plain.size()));
            if (isNew) ids.push_back(id);
            ASSERT_EQ(numbers.of(id), found->second);
        }
        ASSERT_EQ(std::vector<std::uint32_t>(numbers.ids().begin(), numbers.ids().end()), ids);
    }
}

TEST(LocalNumbers, AreThoseOfAMapInEachPart) {
    Random random(11);
    LocalNumbers numbers(40);
    expectNumbersOfAMap(numbers, 40, random);
}

TEST(LocalNumbers, StartAnewWhenAllAreGiven) {
    Random random(12);
    LocalNumbers numbers(40, 100);
    expectNumbersOfAMap(numbers, 40, random);
}

} // namespace
} // namespace gnomon::levels
