// An open file: modes, places, moves, locks and holes.
#include "core/error.h"
#include "core/file.h"
#include "core/random.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include <unistd.h>

namespace gnomon {
namespace {

class OpenFile : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(path); }

    std::string message(const std::function<void()>& act) {
        try {
            act();
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    }

    std::string path = testing::TempDir() + "gnomon_open_file_" + std::to_string(::getpid());
};

std::span<const std::byte> bytesOf(std::string_view text) {
    return std::as_bytes(std::span(text));
}

TEST_F(OpenFile, CreateTruncatesAndUpdateKeeps) {
    writeTextFile(path, "0123456789");
    {
        File update(path, File::Mode::Update);
        EXPECT_EQ(update.size(), 10U);
        update.writeAt(3, bytesOf("xyz"));
    }
    EXPECT_EQ(readTextFile(path), "012xyz6789");
    File create(path, File::Mode::Create);
    EXPECT_EQ(create.size(), 0U);
    create.writeAt(2, bytesOf("ab"));
    std::array<char, 4> back{};
    create.readAt(0, std::as_writable_bytes(std::span(back)));
    EXPECT_EQ(std::string_view(back.data(), 4), std::string_view("\0\0ab", 4)) << "Create allows reading back";
}

TEST_F(OpenFile, AReadOnlyFileTakesNoBytesAndSaysWhere) {
    writeTextFile(path, "0123");
    File file(path, File::Mode::Read);
    EXPECT_EQ(message([&] { file.writeAt(2, bytesOf("x")); }), path + ": byte 2: cannot write: Bad file descriptor");
    EXPECT_EQ(message([&] { file.resize(1); }).find(path + ": cannot resize"), 0U);
    EXPECT_EQ(readTextFile(path), "0123");
    EXPECT_EQ(
        message([&] { File(path + "_absent", File::Mode::Update); }),
        path + "_absent: cannot open: No such file or directory");
}

TEST_F(OpenFile, AToldPathStandsInEveryMessage) {
    writeTextFile(path, "0123");
    const File file(path, File::Mode::Read, "model.gnm");
    EXPECT_EQ(file.path(), "model.gnm");
    std::array<std::byte, 5> five{};
    EXPECT_EQ(
        message([&] { file.readAt(1, five); }),
        "model.gnm: byte 4: the file ends too early: expected 2 more bytes, found the end");
}

TEST_F(OpenFile, AMovedFileIsTheSameFile) {
    File first(path, File::Mode::Create);
    File second(std::move(first));
    second.writeAt(0, bytesOf("kept"));
    File third(path + "2", File::Mode::Create);
    third = std::move(second);
    std::filesystem::remove(path + "2");
    third.writeAt(4, bytesOf(" on"));
    EXPECT_EQ(third.path(), path);
    File& itself = third;
    third = std::move(itself);
    EXPECT_EQ(third.size(), 7U) << "assigned to itself it stays open";
}

TEST_F(OpenFile, ReadSomeGoesOnWhereItStopped) {
    writeTextFile(path, "abcdefgh");
    File file(path, File::Mode::Read);
    std::array<char, 3> some{};
    std::string all;
    while (const std::size_t got = file.readSome(std::as_writable_bytes(std::span(some))))
        all.append(some.data(), got);
    EXPECT_EQ(all, "abcdefgh");
    EXPECT_EQ(file.readSomeAt(6, std::as_writable_bytes(std::span(some))), 2U);
    EXPECT_EQ(file.readSomeAt(9, std::as_writable_bytes(std::span(some))), 0U);
}

TEST_F(OpenFile, ResizeCutsAndLengthensByZeros) {
    File file(path, File::Mode::Create);
    file.writeAt(0, bytesOf("abcdef"));
    file.resize(2);
    EXPECT_EQ(file.size(), 2U);
    file.resize(4);
    file.sync();
    EXPECT_EQ(readTextFile(path), std::string("ab\0\0", 4));
}

TEST_F(OpenFile, AReleasedRangeLeavesWhatIsAroundIt) {
    Random random(1);
    std::string text(std::size_t{64} * 1024, ' ');
    for (char& letter : text)
        letter = static_cast<char>('a' + random.below(26));
    writeTextFile(path, text);
    File file(path, File::Mode::Update);
    file.release(8192, 16384);
    EXPECT_EQ(file.size(), text.size());
    const std::string left = readTextFile(path);
    EXPECT_EQ(left.substr(0, 8192), text.substr(0, 8192));
    EXPECT_EQ(left.substr(24576), text.substr(24576));
    const std::string hole = left.substr(8192, 16384);
    EXPECT_TRUE(hole == std::string(16384, '\0') || hole == text.substr(8192, 16384)) << "zeros, or as it was";
}

TEST_F(OpenFile, TheLockIsOneAndEndsWithTheFile) {
    writeTextFile(path, "x");
    std::optional<File> first(std::in_place, path, File::Mode::Read);
    File second(path, File::Mode::Read);
    EXPECT_TRUE(first->tryLock());
    EXPECT_TRUE(first->tryLock()) << "it has it already";
    EXPECT_FALSE(second.tryLock());
    first.reset();
    EXPECT_TRUE(second.tryLock());
}

} // namespace
} // namespace gnomon
