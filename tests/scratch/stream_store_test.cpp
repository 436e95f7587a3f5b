// Many streams in one scratch file: each comes out as it went in, whatever the size of a block.
#include "core/random.h"
#include "hierarchy/bytes.h"
#include "preprocess/scratch/stream_store.h"

#include <gtest/gtest.h>

namespace gnomon::scratch {
namespace {

class Store : public testing::TestWithParam<std::size_t> {
protected:
    NoProgress progress;
    TemporarySpace space{progress};
    std::unique_ptr<ScratchFile> file = scratchInMemory(space);
};

/// Appends the same at random to a store and to plain vectors.
std::vector<std::vector<std::byte>> fill(StreamStore& store, std::uint32_t streams, int appends, std::uint64_t seed) {
    Random random(seed);
    std::vector<std::vector<std::byte>> plain(streams);
    for (int i = 0; i < appends; ++i) {
        const auto stream = static_cast<std::uint32_t>(random.below(streams));
        std::vector<std::byte> bytes(random.below(40));
        for (std::byte& byte : bytes)
            byte = static_cast<std::byte>(random.bits());
        store.append(stream, bytes);
        plain[stream].insert(plain[stream].end(), bytes.begin(), bytes.end());
    }
    return plain;
}

TEST_P(Store, StreamsComeOutAsTheyWentIn) {
    StreamStore store(*file, 7, GetParam());
    const std::vector<std::vector<std::byte>> plain = fill(store, 7, 600, 1);
    for (std::uint32_t s = 0; s < 7; ++s)
        EXPECT_EQ(store.bytes(s), plain[s].size()) << "what is in memory counts";
    store.flush();
    for (std::uint32_t s = 0; s < 7; ++s) {
        EXPECT_EQ(store.bytes(s), plain[s].size());
        EXPECT_EQ(store.read(s), plain[s]);
        StreamStore::Reader reader(store, s);
        for (const std::byte byte : plain[s]) {
            ASSERT_FALSE(reader.isAtEnd());
            ASSERT_EQ(reader.take<std::byte>(), byte);
        }
        EXPECT_TRUE(reader.isAtEnd());
    }
}

TEST_P(Store, ValuesMayCrossBlocks) {
    StreamStore store(*file, 2, GetParam());
    std::vector<std::uint64_t> values;
    Random random(2);
    for (int i = 0; i < 300; ++i) {
        values.push_back(random.bits());
        store.put(1, values.back());
        if (i % 7 == 0) store.put(0, std::uint8_t{1});
    }
    store.flush();
    EXPECT_EQ(store.readAs<std::uint64_t>(1), values);
    EXPECT_EQ(store.readAs<std::uint8_t>(0), std::vector<std::uint8_t>(43, 1));
    StreamStore::Reader reader(store, 1);
    for (const std::uint64_t value : values)
        ASSERT_EQ(reader.take<std::uint64_t>(), value);
    EXPECT_TRUE(reader.isAtEnd());
}

TEST_P(Store, AnotherProcessFindsAllByTheDirectory) {
    StreamStore store(*file, 5, GetParam());
    const std::vector<std::vector<std::byte>> plain = fill(store, 5, 200, 3);
    store.flush();
    const StreamStore again(*file, store.directory());
    for (std::uint32_t s = 0; s < 5; ++s)
        EXPECT_EQ(again.read(s), plain[s]);
    std::vector<std::byte> longer = store.directory();
    EXPECT_THROW(StreamStore(*file, std::span(longer).first(3)), hierarchy::Damage);
    longer.push_back(std::byte{0});
    EXPECT_THROW(StreamStore(*file, longer), hierarchy::Damage);
}

TEST_P(Store, AReleasedStreamGivesItsSpaceBackAndTheOthersStay) {
    StreamStore store(*file, 3, GetParam());
    const std::vector<std::vector<std::byte>> plain = fill(store, 3, 300, 4);
    store.flush();
    EXPECT_EQ(space.bytes(), plain[0].size() + plain[1].size() + plain[2].size());
    store.release(1);
    EXPECT_EQ(space.bytes(), plain[0].size() + plain[2].size());
    EXPECT_EQ(store.bytes(1), 0U);
    EXPECT_TRUE(store.read(1).empty());
    EXPECT_TRUE(StreamStore::Reader(store, 1).isAtEnd());
    EXPECT_EQ(store.read(0), plain[0]);
    EXPECT_EQ(store.read(2), plain[2]);
}

INSTANTIATE_TEST_SUITE_P(BlockSizes, Store, testing::Values(1, 8, 39, 40, 1000, 1 << 20));

} // namespace
} // namespace gnomon::scratch
