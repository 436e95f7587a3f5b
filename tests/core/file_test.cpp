#include "core/error.h"
#include "core/file.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <sys/stat.h>
#include <sys/wait.h>
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

TEST(File, WithAnotherNameIsReplacedAndNeverChanged) {
    const std::string path = scratch("linked");
    const std::string other = scratch("other");
    writeTextFile(other, "theirs");
    std::filesystem::create_hard_link(other, path);
    EXPECT_THROW(File(path, File::Mode::Update), Error);
    writeTextFile(path, "ours");
    EXPECT_EQ(readTextFile(other), "theirs");
    File(path, File::Mode::Update).writeAt(0, std::as_bytes(std::span("O", 1)));
    EXPECT_EQ(readTextFile(path), "Ours");
    std::filesystem::remove(path);
    std::filesystem::create_hard_link(other, path);
    File(path, File::Mode::Create).writeAt(0, std::as_bytes(std::span("new", 3)));
    EXPECT_EQ(readTextFile(other), "theirs");
    std::filesystem::remove(path);
    std::filesystem::remove(other);
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

/// The name of the one half-written file of `path`.
std::string temporaryOf(const std::string& path) {
    const std::filesystem::path file(path);
    for (const auto& entry : std::filesystem::directory_iterator(file.parent_path()))
        if (entry.path().string().starts_with(path + ".") && entry.path().extension() == ".partial")
            return entry.path().string();
    return "";
}

TEST(File, ALinkThatWaitsUnderTheTemporaryNameIsNotWrittenThrough) {
    const std::string path = scratch("planted");
    const std::string victim = scratch("victim");
    const std::string link = path + "." + std::to_string(::getpid()) + ".partial"; // what could be foreseen once
    writeTextFile(victim, "precious");
    std::filesystem::create_symlink(victim, link);
    writeTextFile(path, "own");
    EXPECT_EQ(readTextFile(victim), "precious");
    EXPECT_EQ(readTextFile(path), "own");
    EXPECT_TRUE(std::filesystem::is_symlink(link)) << "it was somebody else's";
    {
        AtomicFile first(path);
        const std::string name = temporaryOf(path);
        const AtomicFile second(path);
        EXPECT_NE(name, "");
    }
    for (const std::string& name : {path, victim, link})
        std::filesystem::remove(name);
    EXPECT_EQ(temporaryOf(path), "");
}

TEST(File, OnlyReadingFollowsALink) {
    const std::string victim = scratch("followed");
    const std::string link = scratch("following");
    writeTextFile(victim, "precious");
    std::filesystem::create_symlink(victim, link);
    EXPECT_THROW(File(link, File::Mode::Update), Error);
    EXPECT_THROW(File(link, File::Mode::Lock), Error);
    File(link, File::Mode::Create).writeAt(0, std::as_bytes(std::span("new")));
    EXPECT_FALSE(std::filesystem::is_symlink(link));
    EXPECT_EQ(readTextFile(victim), "precious");
    std::filesystem::remove(link);
    std::filesystem::remove(victim);
}

TEST(File, AFileThatIsReplacedHandsOnItsPermissions) {
    const std::string path = scratch("private");
    const auto permissions = [](const std::string& name) {
        struct stat info {};

        EXPECT_EQ(::stat(name.c_str(), &info), 0);
        return info.st_mode & 07777U;
    };
    for (const mode_t mode : {0600U, 0640U, 0664U, 0444U}) {
        writeTextFile(path, "before");
        ASSERT_EQ(::chmod(path.c_str(), mode), 0);
        AtomicFile file(path);
        EXPECT_EQ(permissions(temporaryOf(path)), mode) << "it is as private while it is written";
        file.commit();
        EXPECT_EQ(permissions(path), mode);
        std::filesystem::remove(path);
    }
    const mode_t mask = ::umask(0027);
    writeTextFile(path, "new");
    ::umask(mask);
    EXPECT_EQ(permissions(path), 0640U);
    if (::geteuid() == 0) { // who else could tell
        ASSERT_EQ(::chown(path.c_str(), 12345, 23456), 0);
        writeTextFile(path, "again");

        struct stat info {};

        ASSERT_EQ(::stat(path.c_str(), &info), 0);
        EXPECT_EQ(info.st_uid, 12345U);
        EXPECT_EQ(info.st_gid, 23456U);
    }
    std::filesystem::remove(path);
}

TEST(File, ASignalWhileAFileIsOpenedIsNotSeen) {
    const std::string pipe = scratch("interrupted");
    std::filesystem::remove(pipe);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);

    struct sigaction action {};

    action.sa_handler = [](int) {}; // no SA_RESTART: the call ends with EINTR
    ASSERT_EQ(::sigaction(SIGUSR1, &action, nullptr), 0);
    std::string text;
    std::string failure;
    std::thread reader([&] {
        try {
            text = readTextFile(pipe); // waits for a writer
        } catch (const Error& error) {
            failure = error.what();
        }
    });
    for (int i = 0; i < 5; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        ::pthread_kill(reader.native_handle(), SIGUSR1);
    }
    // Opened for both, so that this ends even where the reader has given up.
    std::fstream writer(pipe, std::ios::in | std::ios::out);
    writer << "arrived" << std::flush;
    if (failure.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    writer.close();
    reader.join();
    EXPECT_EQ(failure, "");
    EXPECT_EQ(text, "arrived");
    std::filesystem::remove(pipe);
}

TEST(File, AProcessThatIsEndedTakesItsHalfWrittenFilesWithIt) {
    const std::string path = scratch("ended");
    const std::string folder = scratch("ended_folder");
    const pid_t child = ::fork();
    if (child == 0) {
        const TemporaryName made(folder, [&] { return ::mkdir(folder.c_str(), 0700) == 0; });
        const AtomicFile first(path);
        const AtomicFile second(path);
        AtomicFile(path + "_whole").commit();
        std::signal(SIGUSR1, [](int) { TemporaryName::removeAllAndExit(7); });
        ::raise(SIGUSR1);
        ::_exit(8);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 7);
    EXPECT_EQ(temporaryOf(path), "");
    EXPECT_FALSE(std::filesystem::exists(folder));
    EXPECT_TRUE(std::filesystem::remove(path + "_whole"));
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
