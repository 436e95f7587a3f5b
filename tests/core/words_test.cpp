// Lists of words: each value has its word and each word its value.
#include "core/words.h"

#include <gtest/gtest.h>

#include <array>

namespace gnomon {
namespace {

enum class Metal { Iron, Tin, Gold };

constexpr std::array kMetals = {Word<Metal>{Metal::Iron, "iron"}, Word<Metal>{Metal::Tin, "tin"}};

TEST(Words, LeadFromValuesToWordsAndBack) {
    for (const auto& [value, word] : kMetals) {
        EXPECT_EQ(wordOf(kMetals, value), word);
        EXPECT_EQ(valueOf(kMetals, word), value);
    }
    EXPECT_EQ(wordOf(kMetals, Metal::Gold), "") << "it is not in the list";
    for (const char* none : {"", "gold", "Iron", "iron ", "iro"})
        EXPECT_FALSE(valueOf(kMetals, none)) << none;
}

TEST(Words, AreEnumerated) {
    constexpr std::array kOne = {Word<int>{1, "off"}};
    constexpr std::array kThree = {Word<int>{1, "off"}, Word<int>{2, "maps"}, Word<int>{3, "rays"}};
    EXPECT_EQ(enumerated(kOne, ", ", " or "), "off");
    EXPECT_EQ(enumerated(kMetals, ", ", " or "), "iron or tin");
    EXPECT_EQ(enumerated(kThree, ", ", " or "), "off, maps or rays");
    EXPECT_EQ(enumerated(kThree, "|", "|"), "off|maps|rays");
}

} // namespace
} // namespace gnomon
