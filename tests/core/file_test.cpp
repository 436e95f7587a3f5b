#include "core/error.h"
#include "core/file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include <sys/stat.h>
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

TEST(File, WhatIsNoFileIsWrittenToAndNeverReplaced) {
    const std::string pipe = scratch("pipe");
    std::filesystem::remove(pipe);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    { AtomicFile abandoned(pipe); }
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    AtomicFile(pipe).commit();
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    EXPECT_THROW(AtomicFile{testing::TempDir()}, Error); // before any work is done for it
    std::filesystem::remove(pipe);
}

TEST(File, ATextIsReadToTheEndOfAPipe) {
    const std::string pipe = scratch("text_pipe");
    std::filesystem::remove(pipe);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const std::size_t length : {0U, 1U, 4095U, 4096U, 4097U, 300000U}) {
        std::string text(length, 'x');
        for (std::size_t i = 0; i < length; ++i)
            text[i] = static_cast<char>('a' + i % 23);
        std::thread writer([&] { std::ofstream(pipe) << text; });
        EXPECT_EQ(readTextFile(pipe), text) << length;
        writer.join();
        writeTextFile(scratch("text"), text);
        EXPECT_EQ(readTextFile(scratch("text")), text) << length;
    }
    EXPECT_EQ(readTextFile("/dev/null"), "");
    EXPECT_FALSE(readTextFile("/proc/self/status").empty()) << "its size is 0 for all that it says";
    std::filesystem::remove(pipe);
    std::filesystem::remove(scratch("text"));
}

TEST(File, WhatCannotBeCreatedIsNamedAsItWasAskedFor) {
    const std::string path = scratch("no_folder") + "/p.png";
    try {
        AtomicFile file(path);
        ADD_FAILURE() << "there is no such folder";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(path + ": cannot create"), std::string::npos) << error.what();
    }
}

TEST(File, ALinkStaysOneAndItsFileIsReplaced) {
    const std::string target = scratch("target");
    const std::string link = scratch("link");
    std::filesystem::remove(link);
    std::filesystem::remove(target);
    std::filesystem::create_symlink(target, link);
    for (const char* text : {"made", "replaced"}) {
        writeTextFile(link, text);
        EXPECT_TRUE(std::filesystem::is_symlink(link));
        EXPECT_FALSE(std::filesystem::is_symlink(target));
        EXPECT_EQ(readTextFile(target), text);
    }
    std::filesystem::remove(link);
    std::filesystem::remove(target);
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
