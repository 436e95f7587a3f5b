// Copies of what was read: found as they were kept, without a file that anybody sees, and no more than a help.
#include "core/error.h"
#include "preprocess/scratch/local_copies.h"
#include "preprocess/scratch/parted_scratch.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include <sys/resource.h>
#include <unistd.h>

namespace gnomon::scratch {
namespace {

std::vector<std::byte> filled(std::size_t size, int value) {
    return {size, static_cast<std::byte>(value)};
}

class Local : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder); }

    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string folder = testing::TempDir() + "gnomon_copies_" + std::to_string(::getpid());
};

TEST_F(Local, FindsWholePiecesUntilTheyAreCleared) {
    LocalCopies copies(folder);
    EXPECT_TRUE(std::filesystem::is_empty(folder)) << "its file has no name";
    copies.keep(5, filled(1000, 1));
    copies.keep(placeOf(3, 5), filled(2000, 2));
    copies.keep(9, filled(10, 3));
    std::vector<std::byte> out(1000);
    EXPECT_TRUE(copies.read(5, out));
    EXPECT_EQ(out, filled(1000, 1));
    EXPECT_FALSE(copies.read(6, out)) << "within a piece";
    EXPECT_FALSE(copies.read(placeOf(3, 5), out)) << "half of a piece";
    out.resize(2000);
    EXPECT_TRUE(copies.read(placeOf(3, 5), out));
    EXPECT_EQ(out, filled(2000, 2));
    out.resize(10);
    EXPECT_FALSE(copies.read(9, out)) << "too small to be worth it";
    copies.clear();
    out.resize(1000);
    EXPECT_FALSE(copies.read(5, out));
    copies.keep(5, filled(1000, 4));
    EXPECT_TRUE(copies.read(5, out));
    EXPECT_EQ(out, filled(1000, 4));
    EXPECT_THROW(LocalCopies("/nowhere/at/all"), Error);
}

TEST_F(Local, ServesManyThreads) {
    LocalCopies copies(folder);
    std::vector<std::thread> threads;
    threads.reserve(4);
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&copies, t] {
            for (std::uint64_t i = 0; i < 100; ++i) {
                const std::uint64_t place = i * 4 + static_cast<std::uint64_t>(t);
                copies.keep(place, filled(300 + i, t));
                std::vector<std::byte> out(300 + i);
                EXPECT_TRUE(copies.read(place, out));
                EXPECT_EQ(out, filled(300 + i, t));
            }
        });
    for (std::thread& thread : threads)
        thread.join();
}

TEST_F(Local, AFullDiskEndsCopiesAndNothingElse) {
    LocalCopies copies(folder);
    copies.keep(1, filled(1000, 1));

    struct rlimit before {};

    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    struct rlimit limit = before;
    limit.rlim_cur = 1500; // the longest file that may be
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &limit);
    copies.keep(2, filled(1000, 2));
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    copies.keep(3, filled(1000, 3));
    std::vector<std::byte> out(1000);
    EXPECT_TRUE(copies.read(1, out));
    EXPECT_FALSE(copies.read(2, out));
    EXPECT_FALSE(copies.read(3, out)) << "no more is tried";
}

// Reads of copies are no reads of the shared folder: they are not counted.
TEST_F(Local, SparesAScratchFileWhatIsReadAgain) {
    NoProgress progress;
    TemporarySpace space(progress);
    PartedScratch writer(folder + "/scratch.", 0, space);
    PartedScratch reader(folder + "/scratch.", 1, space, folder);
    const Block a = writer.append(filled(1000, 1));
    const Block b = writer.append(filled(3000, 2));
    std::vector<std::byte> small(1000);
    std::vector<std::byte> large(3000);
    reader.read(b, large);
    EXPECT_EQ(space.bytesRead(), 3000U) << "unless told, nothing is kept";
    reader.handleCopies(Copies::Keep);
    for (int i = 0; i < 3; ++i) {
        reader.read(a, small);
        reader.read(b, large);
        EXPECT_EQ(small, filled(1000, 1));
        EXPECT_EQ(large, filled(3000, 2));
        EXPECT_EQ(space.bytesRead(), 7000U) << "once each";
    }
    reader.handleCopies(Copies::Use);
    reader.read(a, small);
    EXPECT_EQ(space.bytesRead(), 7000U);
    reader.handleCopies(Copies::Drop);
    reader.read(a, small);
    EXPECT_EQ(small, filled(1000, 1));
    EXPECT_EQ(space.bytesRead(), 8000U);
}

} // namespace
} // namespace gnomon::scratch
