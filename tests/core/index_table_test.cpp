// The hash table against std::map, with hashes that collide as badly as they can.
#include "core/index_table.h"

#include <gtest/gtest.h>

#include <map>

namespace gnomon {
namespace {

/// Keys in an array and the table over it, beside a map that says what every answer must be.
struct TablePair {
    explicit TablePair(std::size_t count, std::uint64_t hashMask) : table(count), mask(hashMask) {}

    std::uint64_t hash(std::uint32_t key) const { return mix64(key) & mask; }

    std::uint32_t findOrInsert(std::uint32_t key) {
        keys.push_back(key);
        const auto index = static_cast<std::uint32_t>(keys.size() - 1);
        const std::uint32_t found =
            table.findOrInsert(hash(key), index, [&](std::uint32_t i) { return keys[i] == key; });
        if (found != index) keys.pop_back();
        return found;
    }

    std::uint32_t find(std::uint32_t key) const {
        return table.find(hash(key), [&](std::uint32_t i) { return keys[i] == key; });
    }

    IndexTable table;
    std::uint64_t mask;
    std::vector<std::uint32_t> keys;
    std::map<std::uint32_t, std::uint32_t> expected;
};

void compareWithMap(Random& random, std::size_t count, std::uint64_t hashMask) {
    TablePair pair(count, hashMask);
    for (std::size_t i = 0; i < 3 * count; ++i) {
        const auto key = static_cast<std::uint32_t>(random.below(count)); // so never more than `count` different ones
        const auto next = static_cast<std::uint32_t>(pair.keys.size());
        const std::uint32_t expected = pair.expected.try_emplace(key, next).first->second;
        ASSERT_EQ(pair.findOrInsert(key), expected);
    }
    for (std::uint32_t key = 0; key < 2 * count; ++key) {
        const auto found = pair.expected.find(key);
        ASSERT_EQ(pair.find(key), found == pair.expected.end() ? IndexTable::kAbsent : found->second) << key;
        pair.table.prefetch(pair.hash(key));
    }
}

TEST(IndexTable, AnswersAsAMapDoes) {
    Random random(1);
    for (const std::size_t count : {1U, 2U, 15U, 16U, 17U, 1000U})
        compareWithMap(random, count, ~std::uint64_t{0});
}

TEST(IndexTable, AnswersAsAMapDoesWhereAllHashesAreEqualOrWrapAround) {
    Random random(2);
    compareWithMap(random, 60, 0);
    compareWithMap(random, 60, 3);
    TablePair wrapping(8, 0);
    // The last slot of the sixteen: what collides there goes on at the first.
    for (std::uint32_t key = 0; key < 8; ++key)
        EXPECT_EQ(wrapping.table.findOrInsert(15, key, [&](std::uint32_t i) { return i == key; }), key);
    for (std::uint32_t key = 0; key < 8; ++key)
        EXPECT_EQ(wrapping.table.find(31, [&](std::uint32_t i) { return i == key; }), key);
}

TEST(IndexTable, AHashOfThreeNumbersDependsOnEachAndOnTheirOrder) {
    const std::uint64_t hash = hashOf(1, 2, 3);
    EXPECT_EQ(hash, hashOf(1, 2, 3));
    for (const std::uint64_t other :
         {hashOf(0, 2, 3), hashOf(1, 0, 3), hashOf(1, 2, 0), hashOf(2, 1, 3), hashOf(1, 3, 2)})
        EXPECT_NE(hash, other);
}

} // namespace
} // namespace gnomon
