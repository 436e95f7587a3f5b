// Temporary bytes on disk and in memory behave alike, and the space that they take is counted.
#include "core/random.h"
#include "preprocess/scratch/scratch_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

#include <unistd.h>

namespace gnomon::scratch {
namespace {

/// Remembers the last number of bytes that it was told.
class SpaceProgress final : public Progress {
public:
    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t /*count*/) override {}

    void temporarySpace(std::uint64_t bytes) override { told = bytes; }

    std::atomic<std::uint64_t> told{0};
};

class Scratch : public testing::TestWithParam<bool> {
protected:
    void TearDown() override { std::filesystem::remove(path); }

    std::unique_ptr<ScratchFile> make() { return GetParam() ? scratchOnDisk(path, space) : scratchInMemory(space); }

    SpaceProgress progress;
    TemporarySpace space{progress};
    std::string path = testing::TempDir() + "gnomon_scratch_" + std::to_string(::getpid());
};

std::vector<std::byte> randomBytes(Random& random, std::size_t size) {
    std::vector<std::byte> bytes(size);
    for (std::byte& byte : bytes)
        byte = static_cast<std::byte>(random.bits());
    return bytes;
}

TEST_P(Scratch, GivesBackWhatWasAppendedWhereItLies) {
    Random random(1);
    const std::unique_ptr<ScratchFile> file = make();
    std::vector<std::pair<Block, std::vector<std::byte>>> pieces;
    std::uint64_t total = 0;
    for (int i = 0; i < 200; ++i) {
        std::vector<std::byte> bytes = randomBytes(random, random.below(300));
        const Block block = file->append(bytes);
        EXPECT_EQ(block.offset, total);
        EXPECT_EQ(block.bytes, bytes.size());
        total += bytes.size();
        EXPECT_EQ(file->end(), total);
        pieces.emplace_back(block, std::move(bytes));
    }
    for (const auto& [block, bytes] : pieces) {
        std::vector<std::byte> out(bytes.size());
        file->read(block, out);
        EXPECT_EQ(out, bytes);
    }
    EXPECT_EQ(space.bytesRead(), total);
    EXPECT_EQ(space.bytesWritten(), total);
    EXPECT_EQ(space.bytes(), total);
    EXPECT_EQ(progress.told, total);
}

TEST_P(Scratch, WhatIsReleasedIsGivenBackAndTheRestStays) {
    Random random(2);
    const std::unique_ptr<ScratchFile> file = make();
    const std::vector<std::byte> first = randomBytes(random, 5000);
    const std::vector<std::byte> second = randomBytes(random, 3000);
    const Block a = file->append(first);
    const Block b = file->append(second);
    file->release(a);
    file->release({a.offset, 0, 0});
    EXPECT_EQ(space.bytes(), 3000U);
    EXPECT_EQ(space.peakBytes(), 8000U);
    EXPECT_EQ(space.bytesWritten(), 8000U);
    EXPECT_EQ(progress.told, 3000U);
    std::vector<std::byte> out(second.size());
    file->read(b, out);
    EXPECT_EQ(out, second);
    EXPECT_EQ(file->end(), 8000U) << "the next bytes go behind all that ever was";
}

TEST_P(Scratch, IsReadFromManyThreadsWhileItGrows) {
    Random random(3);
    const std::unique_ptr<ScratchFile> file = make();
    const std::vector<std::byte> first = randomBytes(random, 4096);
    const Block place = file->append(first);
    std::vector<std::thread> readers;
    readers.reserve(3);
    std::atomic<int> wrong{0};
    for (int t = 0; t < 3; ++t)
        readers.emplace_back([&] {
            std::vector<std::byte> out(first.size());
            for (int i = 0; i < 200; ++i) {
                file->read(place, out);
                wrong += out == first ? 0 : 1;
            }
        });
    for (int i = 0; i < 200; ++i)
        file->append(first);
    for (std::thread& reader : readers)
        reader.join();
    EXPECT_EQ(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(OnDiskAndInMemory, Scratch, testing::Bool(), [](const auto& name) {
    return name.param ? "OnDisk" : "InMemory";
});

TEST(TemporarySpace, OfOthersMayBeGivenBackBeforeItIsToldOf) {
    NoProgress progress;
    TemporarySpace space(progress);
    space.take(100);
    space.giveBack(300);
    EXPECT_EQ(space.bytes(), 0U);
    space.takeOfOthers(500);
    EXPECT_EQ(space.bytes(), 300U);
    EXPECT_EQ(space.peakBytes(), 300U);
    EXPECT_EQ(space.bytesWritten(), 100U) << "by this process";
}

TEST(TemporarySpace, KeepsToItsRateOverAllThreads) {
    NoProgress progress;
    TemporarySpace space(progress);
    const std::unique_ptr<ScratchFile> file = scratchInMemory(space);
    const std::vector<std::byte> bytes(10'000);
    const Block block = file->append(bytes); // without a limit
    space.limitRate(1'000'000);
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::thread> threads;
    threads.reserve(4);
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            std::vector<std::byte> out(10'000);
            file->append(bytes);
            file->read(block, out);
        });
    for (std::thread& thread : threads)
        thread.join();
    // 80,000 bytes; a busy machine may take longer.
    EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(79));
}

} // namespace
} // namespace gnomon::scratch
