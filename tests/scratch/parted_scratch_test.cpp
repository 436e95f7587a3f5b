// One scratch file for each process, read by all.
#include "core/file.h"
#include "core/random.h"
#include "hierarchy/file_layout.h"
#include "preprocess/scratch/damage_error.h"
#include "preprocess/scratch/parted_scratch.h"
#include "preprocess/scratch/stream_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <thread>

#include <unistd.h>

namespace gnomon::scratch {
namespace {

class Parted : public testing::Test {
protected:
    void TearDown() override {
        for (std::uint32_t part = 0; part < 8; ++part)
            std::filesystem::remove(partPath(stem, part));
    }

    static std::vector<std::byte> bytesOf(std::uint64_t seed, std::size_t size) {
        Random random(seed);
        std::vector<std::byte> bytes(size);
        for (std::byte& byte : bytes)
            byte = static_cast<std::byte>(random.bits());
        return bytes;
    }

    NoProgress progress;
    TemporarySpace space{progress};
    std::string stem = testing::TempDir() + "gnomon_parted_" + std::to_string(::getpid()) + ".";
};

TEST_F(Parted, EachAppendsToItsOwnAndReadsAll) {
    PartedScratch one(stem, 3, space);
    PartedScratch other(stem, 4, space);
    const std::vector<std::byte> first = bytesOf(1, 1000);
    const std::vector<std::byte> second = bytesOf(2, 500);
    const Block a = one.append(first);
    const Block b = other.append(second);
    EXPECT_EQ(a.offset, placeOf(3, 0));
    EXPECT_EQ(partOf(b.offset), 4U);
    EXPECT_EQ(one.append(second).offset, placeOf(3, 1000));
    one.handOver();
    other.handOver();
    EXPECT_EQ(one.read({&b, 1}), second);
    EXPECT_EQ(other.read({&a, 1}), first);
    const Block c = other.append(first); // behind what `one` has opened
    other.handOver();
    one.reopenOthers();
    EXPECT_EQ(one.read({&c, 1}), first);
    EXPECT_EQ(space.bytes(), 3000U);
    one.release(b);
    EXPECT_EQ(space.bytes(), 2500U);
    EXPECT_EQ(other.read({&c, 1}), first);
    const Block nowhere{placeOf(5, 0), 1, 0};
    EXPECT_THROW(one.read({&nowhere, 1}), Error) << "nobody has made it";
    const Block behind{b.offset + 1500, 1, 0};
    EXPECT_THROW(one.read({&behind, 1}), DamageError);
}

TEST_F(Parted, ManyThreadsAppendAtOnce) {
    PartedScratch file(stem, 7, space);
    constexpr std::size_t kThreads = 4;
    constexpr std::uint64_t kPieces = 200;
    std::array<Blocks, kThreads> places;
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < kThreads; ++t)
        threads.emplace_back([&, t] {
            for (std::uint64_t i = 0; i < kPieces; ++i)
                places[t].push_back(file.append(bytesOf(t * kPieces + i, 1 + i)));
        });
    for (std::thread& thread : threads)
        thread.join();
    for (std::size_t t = 0; t < kThreads; ++t)
        for (std::uint64_t i = 0; i < kPieces; ++i)
            ASSERT_EQ(file.read({&places[t][i], 1}), bytesOf(t * kPieces + i, 1 + i));
}

TEST_F(Parted, ResumesWhatWasThereAndCutsTheRest) {
    const std::vector<std::byte> bytes = bytesOf(4, 1000);
    Block first;
    {
        PartedScratch before(stem, 0, space);
        first = before.append(std::span(bytes).first(600));
        before.append(std::span(bytes).last(400));
    }
    TemporarySpace later(progress);
    PartedScratch file(stem, 1, later);
    file.resume(0, 600);
    EXPECT_EQ(later.bytes(), 600U);
    EXPECT_EQ(std::filesystem::file_size(partPath(stem, 0)), 600U);
    EXPECT_EQ(file.read({&first, 1}), std::vector<std::byte>(bytes.begin(), bytes.begin() + 600));
    EXPECT_THROW(file.resume(2, 1), DamageError) << "a file that is missing";
    try {
        file.resume(0, 601);
        ADD_FAILURE() << "a file of 600 bytes";
    } catch (const DamageError& error) {
        EXPECT_EQ(
            std::string(error.what()),
            partPath(stem, 0) + ": the temporary file was cut off: expected 601 bytes, found 600");
    }
}

/// The blocks of three streams, and the bytes that were appended to each.
struct Written {
    std::vector<std::byte> directory;
    std::vector<std::vector<std::byte>> streams;
};

void overwrite(const std::string& path, const std::string& bytes) {
    File(path, File::Mode::Create).writeAt(0, std::as_bytes(std::span(bytes)));
}

/// Fills part 0 with short blocks of similar content.
Written writeStreams(const std::string& stem, TemporarySpace& space) {
    PartedScratch file(stem, 0, space);
    StreamStore store(file, 3, 16);
    Written written{{}, std::vector<std::vector<std::byte>>(3)};
    for (std::uint32_t i = 0; i < 90; ++i) {
        const std::array<std::uint32_t, 1> value{i / 3};
        const auto bytes = std::as_bytes(std::span(value));
        store.append(i % 3, bytes);
        written.streams[i % 3].insert(written.streams[i % 3].end(), bytes.begin(), bytes.end());
    }
    store.flush();
    written.directory = store.directory();
    return written;
}

/// Reads all streams. Returns how many are damaged; all others must have the bytes that were appended.
int damagedStreams(const std::string& stem, const Written& written, TemporarySpace& space) {
    PartedScratch file(stem, 1, space);
    const StreamStore store(file, written.directory);
    int damaged = 0;
    for (std::uint32_t stream = 0; stream < 3; ++stream)
        try {
            EXPECT_EQ(store.read(stream), written.streams[stream]);
        } catch (const DamageError& error) {
            EXPECT_NE(std::string(error.what()).find(partPath(stem, 0) + ": byte "), std::string::npos) << error.what();
            ++damaged;
        }
    return damaged;
}

TEST_F(Parted, EveryDamagedByteIsTold) {
    const Written written = writeStreams(stem, space);
    const std::string path = partPath(stem, 0);
    const std::string whole = readTextFile(path);
    ASSERT_EQ(whole.size(), 360U);
    EXPECT_EQ(damagedStreams(stem, written, space), 0);
    for (std::size_t place = 0; place < whole.size(); ++place) {
        for (const char flip : {'\x01', '\x80'}) {
            std::string bad = whole;
            bad[place] = static_cast<char>(bad[place] ^ flip);
            overwrite(path, bad);
            ASSERT_EQ(damagedStreams(stem, written, space), 1) << place;
        }
        overwrite(path, whole.substr(0, place));
        ASSERT_GE(damagedStreams(stem, written, space), 1) << "cut off at " << place;
    }
}

TEST_F(Parted, BlocksInEachOthersPlaceAreDamage) {
    const Written written = writeStreams(stem, space);
    const std::string path = partPath(stem, 0);
    const std::string whole = readTextFile(path);
    for (std::size_t a = 0; a + 16 <= whole.size(); a += 16)
        for (std::size_t b = 0; b + 16 <= whole.size(); b += 16) {
            std::string bad = whole;
            bad.replace(a, 16, whole, b, 16);
            bad.replace(b, 16, whole, a, 16);
            overwrite(path, bad);
            ASSERT_EQ(damagedStreams(stem, written, space) > 0, bad != whole) << a << " and " << b;
        }
}

} // namespace
} // namespace gnomon::scratch
