// One scratch file for each process, read by all.
#include "core/error.h"
#include "core/random.h"
#include "preprocess/scratch/parted_scratch.h"

#include <gtest/gtest.h>

#include <algorithm>
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

    static std::vector<std::byte> read(const ScratchFile& file, std::uint64_t place, std::size_t size) {
        std::vector<std::byte> bytes(size);
        file.read(place, bytes);
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
    const std::uint64_t a = one.append(first);
    const std::uint64_t b = other.append(second);
    EXPECT_EQ(a, placeOf(3, 0));
    EXPECT_EQ(partOf(b), 4U);
    EXPECT_EQ(one.append(second), placeOf(3, 1000));
    one.handOver();
    other.handOver();
    EXPECT_EQ(read(one, b, 500), second);
    EXPECT_EQ(read(other, a, 1000), first);
    other.append(first); // behind what `one` has opened
    other.handOver();
    one.reopenOthers();
    EXPECT_EQ(read(one, b + 500, 1000), first);
    EXPECT_EQ(space.bytes(), 3000U);
    one.release(b, 500);
    EXPECT_EQ(space.bytes(), 2500U);
    EXPECT_EQ(read(other, b + 500, 1000), first);
    EXPECT_THROW(read(one, placeOf(5, 0), 1), Error) << "nobody has made it";
    EXPECT_THROW(read(one, b + 1500, 1), Error);
}

TEST_F(Parted, ManyThreadsAppendAtOnce) {
    PartedScratch file(stem, 7, space);
    constexpr std::size_t kThreads = 4;
    constexpr std::uint64_t kPieces = 200;
    std::array<std::vector<std::uint64_t>, kThreads> places;
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
            ASSERT_EQ(read(file, places[t][i], 1 + i), bytesOf(t * kPieces + i, 1 + i));
}

TEST_F(Parted, ResumesWhatWasThereAndCutsTheRest) {
    const std::vector<std::byte> bytes = bytesOf(4, 1000);
    PartedScratch(stem, 0, space).append(bytes);
    TemporarySpace later(progress);
    PartedScratch file(stem, 1, later);
    file.resume(0, 600);
    EXPECT_EQ(later.bytes(), 600U);
    EXPECT_EQ(std::filesystem::file_size(partPath(stem, 0)), 600U);
    EXPECT_EQ(read(file, placeOf(0, 0), 600), std::vector<std::byte>(bytes.begin(), bytes.begin() + 600));
    try {
        file.resume(0, 601);
        ADD_FAILURE() << "a file of 600 bytes";
    } catch (const Error& error) {
        EXPECT_EQ(
            std::string(error.what()),
            partPath(stem, 0) + ": the temporary file was cut off: expected 601 bytes, found 600");
    }
}

} // namespace
} // namespace gnomon::scratch
