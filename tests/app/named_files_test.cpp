// The files of a command line: which names are the same file, which outputs are made sure of, and what is left of them.
#include "core/error.h"
#include "core/prepared_output.h"
#include "settings/files/named_files.h"
#include "settings/usage_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

namespace gnomon::app {
namespace {

namespace fs = std::filesystem;
using settings::NamedFile;
using settings::requireDistinctFiles;
using settings::requireExtension;

/// A folder of its own, in which the test stands.
class FilesTest : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder_ / "inner");
        fs::current_path(folder_);
    }

    void TearDown() override {
        fs::current_path(before_);
        fs::remove_all(folder_);
    }

    static void write(const std::string& path, const std::string& text = "text") { std::ofstream(path) << text; }

    static std::string read(const std::string& path) {
        std::stringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    }

    /// What lies in the folder, folders with a slash behind them.
    std::string listing() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            names.push_back(fs::relative(entry.path(), folder_).string() + (entry.is_directory() ? "/" : ""));
        std::sort(names.begin(), names.end());
        std::string all;
        for (const std::string& name : names)
            all += (all.empty() ? "" : " ") + name;
        return all;
    }

    const fs::path& folder() const { return folder_; }

private:
    fs::path before_ = fs::current_path();
    fs::path folder_ = fs::temp_directory_path() / ("gnomon_named_files_" + std::to_string(::getpid()));
};

/// What is said against reading and writing these files; empty if nothing is.
std::string objection(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
    try {
        requireDistinctFiles(inputs, outputs);
        return {};
    } catch (const settings::UsageError& error) {
        return error.message;
    }
}

TEST_F(FilesTest, AnInputIsNotReplacedUnderAnyOfItsNames) {
    write("model.gnm");
    fs::create_symlink("model.gnm", "link.gnm");
    fs::create_hard_link("model.gnm", "hard.gnm");
    fs::create_directory_symlink(".", "here");
    for (const std::string& name : std::vector<std::string>{
             "model.gnm",
             "./model.gnm",
             "inner/../model.gnm",
             "link.gnm",
             "hard.gnm",
             "here/model.gnm",
             "here/link.gnm",
             (folder() / "model.gnm").string(),
             ".//model.gnm"})
        EXPECT_EQ(
            objection({{"MODEL", "model.gnm"}}, {{"-o", name}}), "-o would replace MODEL, which is read: " + name);
    for (const char* name : {"other.gnm", "inner/model.gnm", "Model.gnm", "model.gnm2", ""})
        EXPECT_EQ(objection({{"MODEL", "model.gnm"}}, {{"-o", name}}), "") << name;
}

TEST_F(FilesTest, NoTwoOutputsAreOneFileThoughItIsNotThereYet) {
    EXPECT_EQ(
        objection({}, {{"--csv", "a.csv"}, {"--stats", "b.json"}, {"--json-file", "inner/../a.csv"}}),
        "--csv and --json-file name the same file: inner/../a.csv");
    EXPECT_EQ(objection({}, {{"--csv", "no/such/folder/a"}, {"-o", "no/such/folder/../folder/a"}}).empty(), false);
    EXPECT_EQ(objection({}, {{"--csv", "a"}, {"-o", "b"}, {"--stats", ""}, {"--depth", ""}}), "") << "not given";
}

TEST_F(FilesTest, TheFirstClashIsToldAndInputsMayBeTheSame) {
    write("a");
    EXPECT_EQ(objection({{"INPUT", "a"}, {"INPUT", "a"}}, {}), "");
    EXPECT_EQ(
        objection({{"MODEL", "x"}, {"--path", "a"}}, {{"-o", "b"}, {"--csv", "a"}, {"--stats", "b"}}),
        "--csv would replace --path, which is read: a");
}

TEST_F(FilesTest, DevicesAndPipesMayBeNamedTwice) {
    EXPECT_EQ(objection({}, {{"--csv", "/dev/null"}, {"-o", "/dev/null"}}), "");
    ASSERT_EQ(::mkfifo("pipe", 0600), 0);
    EXPECT_EQ(objection({{"MODEL", "pipe"}}, {{"-o", "pipe"}}), "");
}

std::string objectionToName(const std::string& path) {
    try {
        requireExtension("-o", path, ".png");
        return {};
    } catch (const settings::UsageError& error) {
        return error.message;
    }
}

TEST_F(FilesTest, AnExtensionPromisesItsFormat) {
    for (const char* name : {"a.png", "a.PNG", "a.b.png", "/dev/stdout", "picture", "folder.d/picture", "-", ".png"})
        EXPECT_EQ(objectionToName(name), "") << name;
    for (const char* name : {"a.jpg", "a.png.gz", "a.", "folder.png/a.ppm"})
        EXPECT_EQ(objectionToName(name), "-o: expected a name ending in .png, found '" + std::string(name) + "'");
}

TEST_F(FilesTest, APreparedFileIsThereOnlyOnceItIsWritten) {
    {
        PreparedFile file("out.json");
        EXPECT_FALSE(fs::exists("out.json"));
    }
    EXPECT_EQ(listing(), "inner/") << "nothing was written, and nothing is left";
    {
        PreparedFile file("out.json");
        file.write("all of it");
        EXPECT_EQ(read("out.json"), "all of it");
    }
    EXPECT_EQ(listing(), "inner/ out.json");
    PreparedFile("out.json").write("again");
    EXPECT_EQ(read("out.json"), "again");
    { const PreparedFile unwritten("out.json"); }
    EXPECT_EQ(read("out.json"), "again") << "what was there stays";
    PreparedFile("").write("nowhere");
    EXPECT_EQ(listing(), "inner/ out.json");
}

TEST_F(FilesTest, WhatCannotBeMadeIsToldBeforeTheWork) {
    write("file");
    for (const char* name : {"no/such/folder/out.json", "file/out.json", "inner"}) {
        EXPECT_THROW(PreparedFile{name}, Error) << name;
        EXPECT_THROW(requireWritable(name), Error) << name;
    }
    requireWritable("later.json");
    requireWritable("");
    requireWritable("/dev/null");
    ASSERT_EQ(::mkfifo("pipe", 0600), 0);
    requireWritable("pipe"); // would wait for its reader
    requireWritable("file");
    EXPECT_EQ(read("file"), "text");
    EXPECT_EQ(listing(), "file inner/ pipe") << "a trial leaves nothing";
}

TEST_F(FilesTest, OfAPreparedFolderThatStaysWhichHoldsSomething) {
    {
        const PreparedFolder none("");
        const PreparedFolder folder("a/b/c");
        EXPECT_EQ(listing(), "a/ a/b/ a/b/c/ inner/");
    }
    EXPECT_EQ(listing(), "inner/");
    {
        const PreparedFolder folder("a/b/c/");
        write("a/b/kept");
    }
    EXPECT_EQ(listing(), "a/ a/b/ a/b/kept inner/") << "c was empty, b was not";
    { const PreparedFolder folder("inner/../inner"); }
    EXPECT_EQ(listing(), "a/ a/b/ a/b/kept inner/") << "what was there before is not its own";
    {
        const PreparedFolder outer("x");
        const PreparedFolder within("x/y");
        write("x/y/kept");
    }
    EXPECT_EQ(listing(), "a/ a/b/ a/b/kept inner/ x/ x/y/ x/y/kept");
}

TEST_F(FilesTest, AFolderThatIsNoneIsRefused) {
    write("file");
    EXPECT_THROW(PreparedFolder("file"), Error);
    EXPECT_THROW(PreparedFolder("file/below"), Error);
    EXPECT_EQ(listing(), "file inner/");
    EXPECT_EQ(read("file"), "text");
}

} // namespace
} // namespace gnomon::app
