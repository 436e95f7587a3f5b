// What an error says, and how a programmer's check ends.
#include "core/check.h"
#include "core/error.h"
#include "core/limit_error.h"
#include "core/printable.h"
#include "core/progress.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace gnomon {
namespace {

TEST(Error, SaysWhatWhereExpectedAndFound) {
    EXPECT_STREQ(Error("no light").what(), "no light");
    EXPECT_STREQ(Error("a.ply", "no faces").what(), "a.ply: no faces");
    EXPECT_STREQ(Error("a.ply", "wrong count", "3", "4").what(), "a.ply: wrong count: expected 3, found 4");
    EXPECT_EQ(atByte("a.gnm", 18446744073709551615ULL), "a.gnm: byte 18446744073709551615");
    EXPECT_EQ(atLine("a.obj", 1), "a.obj:1");
}

TEST(Error, TellsTheStandardLibrarysInTheSameOrder) {
    try {
        std::filesystem::create_directories("/dev/null/folder");
        FAIL() << "a folder within a device";
    } catch (const std::exception& error) {
        EXPECT_EQ(inWords(error), "/dev/null/folder: cannot create directories: Not a directory");
    }
    EXPECT_EQ(inWords(std::runtime_error("filesystem error: x: y")), "filesystem error: x: y")
        << "whose words are its own";
    EXPECT_EQ(inWords(Error("a.ply", "no faces")), "a.ply: no faces");
}

TEST(LimitError, IsAnErrorThatKnowsItsParts) {
    const LimitError error(Limit::Memory, {"a.ply", "too little memory", "512M or more", "1.0 MiB"});
    EXPECT_STREQ(error.what(), "a.ply: too little memory: expected 512M or more, found 1.0 MiB");
    EXPECT_EQ(error.limit(), Limit::Memory);
    EXPECT_EQ(error.parts().where, "a.ply");
    EXPECT_EQ(error.parts().what, "too little memory");
    EXPECT_EQ(error.parts().expected, "512M or more");
    EXPECT_EQ(error.parts().found, "1.0 MiB");
}

TEST(CheckDeathTest, PrintsTheExpressionAndBothValues) {
    const int three = 3;
    const int four = 4;
    GNOMON_CHECK(three < four);
    GNOMON_CHECK_OP(three, <, four);
    EXPECT_DEATH(GNOMON_CHECK(three > four), "internal check failed at .*error_test.cpp:[0-9]+: three > four");
    EXPECT_DEATH(GNOMON_CHECK_OP(three, ==, four), "three == four \\(3 against 4\\)");
}

TEST(Progress, ThatNobodyWatchesTakesEverything) {
    NoProgress nobody;
    Progress& progress = nobody;
    progress.stage("read", "bytes", 0);
    progress.advance(18446744073709551615ULL);
    progress.temporarySpace(1);
}

} // namespace
} // namespace gnomon
