#include "core/error.h"
#include "core/file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

namespace gnomon {
namespace {

std::string scratch(const std::string& name) {
    return testing::TempDir() + "gnomon_file_" + std::to_string(::getpid()) + "_" + name;
}

TEST(File, AnAtomicFileAppearsOnlyWhenCommitted) {
    const std::string path = scratch("atomic");
    std::filesystem::remove(path);
    {
        AtomicFile abandoned(path);
        abandoned.file().writeAt(0, std::as_bytes(std::span("abc")));
        EXPECT_FALSE(std::filesystem::exists(path));
    }
    EXPECT_FALSE(std::filesystem::exists(path));
    writeTextFile(path, "done");
    EXPECT_EQ(readTextFile(path), "done");
}

TEST(File, AnAbandonedWriteLeavesTheOldFile) {
    const std::string path = scratch("old");
    writeTextFile(path, "old");
    { AtomicFile abandoned(path); }
    EXPECT_EQ(readTextFile(path), "old");
}

TEST(File, AShortReadSaysWhereAndHowMuch) {
    const std::string path = scratch("short");
    writeTextFile(path, "12345");
    const File file(path, File::Mode::Read);
    std::array<std::byte, 8> buffer{};
    try {
        file.readAt(0, buffer);
        FAIL() << "a short read passed";
    } catch (const Error& error) {
        EXPECT_EQ(
            std::string(error.what()),
            path + ": byte 5: the file ends too early: expected 3 more bytes, found the end");
    }
    EXPECT_EQ(file.readSomeAt(3, buffer), 2U);
}

TEST(File, AMissingFileIsAnError) {
    EXPECT_THROW(File("/nonexistent/x", File::Mode::Read), Error);
}

TEST(File, ADirectoryIsAnError) {
    EXPECT_THROW(File(testing::TempDir(), File::Mode::Read), Error);
}

} // namespace
} // namespace gnomon
