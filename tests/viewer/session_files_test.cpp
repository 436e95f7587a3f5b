// What a session leaves on disk: pictures, paths and the log, over nothing that is there and never half.
#include "core/error.h"
#include "core/random.h"
#include "viewer/frame_log.h"
#include "viewer/saved_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <unistd.h>

namespace gnomon::viewer {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, in which the session stands.
class SessionFilesTest : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder_);
        fs::current_path(folder_);
        ::unsetenv("XDG_CONFIG_HOME");
        ::setenv("XDG_PICTURES_DIR", place("pictures").c_str(), 1);
        ::setenv("HOME", place("home").c_str(), 1);
    }

    void TearDown() override {
        fs::current_path(before_);
        fs::remove_all(folder_);
    }

    static std::string read(const std::string& path) {
        std::stringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    }

    static std::size_t fileCount() {
        return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator("."), {}));
    }

    std::string place(const std::string& name) const { return (folder_ / name).string(); }

private:
    fs::path before_ = fs::current_path();
    fs::path folder_ = fs::temp_directory_path() / ("gnomon_session_" + std::to_string(::getpid()));
};

render::Picture anyPicture(Random& random) {
    render::Picture picture(1 + static_cast<int>(random.below(9)), 1 + static_cast<int>(random.below(9)));
    for (render::Rgb& pixel : picture.pixels)
        for (std::uint8_t& channel : pixel)
            channel = static_cast<std::uint8_t>(random.below(256));
    return picture;
}

TEST_F(SessionFilesTest, PicturesAreNumberedOverNoneThatIsThere) {
    Random random(1);
    const SavedFiles saved("/any/where/scan.of.bunny.gnm");
    const std::string start = place("pictures") + "/Gnomon/scan.of.bunny_";
    fs::create_directories(place("pictures") + "/Gnomon");
    std::ofstream(start + "2.png") << "mine";
    std::vector<render::Picture> pictures;
    for (const std::string& name : {start + "1.png", start + "3.png", start + "4.png"}) {
        pictures.push_back(anyPicture(random));
        EXPECT_EQ(saved.savePicture(pictures.back()), name);
        EXPECT_EQ(render::readPng(name).pixels, pictures.back().pixels);
    }
    EXPECT_EQ(read(start + "2.png"), "mine");
    fs::remove(start + "1.png");
    EXPECT_EQ(saved.savePicture(pictures[1]), start + "1.png") << "a free number is used again";
    EXPECT_EQ(render::readPng(start + "3.png").pixels, pictures[1].pixels);
    EXPECT_EQ(SavedFiles().savePicture(pictures[0]), place("pictures") + "/Gnomon/gnomon_1.png") << "before any model";
}

TEST_F(SessionFilesTest, PicturesAreInTheFolderThatTheUserDirectoriesName) {
    Random random(6);
    const SavedFiles saved("bunny.gnm");
    const auto folderOf = [&] { return fs::path(saved.savePicture(anyPicture(random))).parent_path().string(); };
    ::unsetenv("XDG_PICTURES_DIR");
    EXPECT_EQ(folderOf(), place("home/Pictures/Gnomon"));
    fs::create_directories(place("home/.config"));
    std::ofstream(place("home/.config/user-dirs.dirs"))
        << "# of xdg-user-dirs\nXDG_MUSIC_DIR=\"$HOME/Music\"\n  XDG_PICTURES_DIR=\"$HOME/Bilder\"\nXDG_PICTURES";
    EXPECT_EQ(folderOf(), place("home/Bilder/Gnomon"));
    ::setenv("XDG_CONFIG_HOME", place("config").c_str(), 1);
    fs::create_directories(place("config"));
    std::ofstream(place("config/user-dirs.dirs")) << "XDG_PICTURES_DIR=\"" << place("elsewhere") << "\"\n";
    EXPECT_EQ(folderOf(), place("elsewhere/Gnomon"));
    std::ofstream(place("file")) << "mine";
    ::setenv("XDG_PICTURES_DIR", place("file").c_str(), 1);
    EXPECT_EQ(folderOf(), place("home/Pictures/Gnomon")) << "where nothing can be written";
    fs::remove_all(place("home/Pictures"));
    std::ofstream(place("home/Pictures")) << "mine";
    EXPECT_EQ(folderOf(), place("home/Gnomon"));
    ::setenv("HOME", place("file").c_str(), 1);
    EXPECT_EQ(folderOf(), "Gnomon");
}

TEST_F(SessionFilesTest, TwoWindowsThatSaveAtOnceLoseNothing) {
    constexpr int kPictures = 40;
    const auto saveAll = [](int width) {
        const SavedFiles saved("bunny.gnm");
        for (int i = 0; i < kPictures; ++i)
            saved.savePicture(render::Picture(width, 1));
    };
    std::thread other([&] { saveAll(1); });
    saveAll(2);
    other.join();
    int wide = 0;
    for (int number = 1; number <= 2 * kPictures; ++number)
        wide += render::readPng(place("pictures/Gnomon/bunny_") + std::to_string(number) + ".png").width - 1;
    EXPECT_EQ(wide, kPictures);
}

TEST_F(SessionFilesTest, MeasuresLieBesideTheModelUnderANumberThatIsFreeForBoth) {
    fs::create_directory("site");
    std::ofstream("site/bunny_measures1.csv") << "mine";
    const SavedFiles saved("site/bunny.gnm");
    EXPECT_EQ(saved.saveMeasures("{}", "a,b\n"), "site/bunny_measures2.json and site/bunny_measures2.csv");
    EXPECT_EQ(read("site/bunny_measures2.json"), "{}");
    EXPECT_EQ(read("site/bunny_measures2.csv"), "a,b\n");
    EXPECT_EQ(read("site/bunny_measures1.csv"), "mine");
    EXPECT_FALSE(fs::exists("site/bunny_measures1.json"));
    EXPECT_EQ(
        SavedFiles("http://localhost/site/bunny.gnm").saveMeasures("", ""),
        "bunny_measures1.json and bunny_measures1.csv")
        << "the folder of a server is no folder here";
    EXPECT_EQ(SavedFiles("nowhere/bunny.gnm").saveMeasures("", ""), "bunny_measures2.json and bunny_measures2.csv");
}

TEST_F(SessionFilesTest, PathsReadBackAndCountForThemselves) {
    const SavedFiles saved("bunny.ply.gnm");
    path::CameraPath path;
    path.keyframes = {{0, {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1}}, {2, {{5, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1}}};
    Random random(2);
    EXPECT_EQ(saved.savePicture(anyPicture(random)), place("pictures/Gnomon/bunny.ply_1.png"));
    EXPECT_EQ(saved.savePath(path), "bunny.ply_path1.json");
    EXPECT_EQ(saved.savePath(path), "bunny.ply_path2.json");
    EXPECT_EQ(path::contentHash(path::readCameraPath("bunny.ply_path2.json")), path::contentHash(path));
}

TEST_F(SessionFilesTest, PlayedFramesAreNumberedInAFolderThatIsMade) {
    Random random(3);
    const SavedFiles saved("bunny.gnm");
    const render::Picture first = anyPicture(random);
    const render::Picture second = anyPicture(random);
    saved.savePlayed("out/of/play", 0, first);
    saved.savePlayed("out/of/play", 12345, second);
    saved.savePlayed("out/of/play", 7, first);
    saved.savePlayed("out/of/play", 7, second); // played again
    EXPECT_EQ(render::readPng("out/of/play/frame0000.png").pixels, first.pixels);
    EXPECT_EQ(render::readPng("out/of/play/frame0007.png").pixels, second.pixels);
    EXPECT_EQ(render::readPng("out/of/play/frame12345.png").pixels, second.pixels);
}

TEST_F(SessionFilesTest, WhatCannotBeWrittenIsToldAndLeavesNothing) {
    Random random(4);
    const render::Picture picture = anyPicture(random);
    std::ofstream("file") << "mine";
    EXPECT_THROW(SavedFiles("bunny.gnm").savePlayed("file", 0, picture), std::exception);
    EXPECT_THROW(FrameLog("no/such/folder/log.csv"), Error);
    EXPECT_EQ(read("file"), "mine");
    EXPECT_EQ(fileCount(), 1U);
}

TEST_F(SessionFilesTest, ALogAppearsWholeWithALineForEachFrame) {
    Random random(5);
    std::string expected = telemetry::csvHeader() + "\n";
    {
        FrameLog log("log.csv");
        for (int frame = 0; frame < 300; ++frame) {
            telemetry::FrameRow row;
            row.frame = frame;
            row.run = "a, \"quoted\" run";
            if (random.below(2) == 0) row.totalMs = random.uniform(1, 100);
            log.add(row);
            expected += telemetry::csvRow(row) + "\n";
        }
        EXPECT_FALSE(fs::exists("log.csv")) << "under its final name once it is complete";
        log.finish();
    }
    EXPECT_EQ(read("log.csv"), expected);
    EXPECT_EQ(fileCount(), 1U);
    {
        FrameLog unfinished("log.csv");
        unfinished.add({});
    }
    EXPECT_EQ(read("log.csv"), expected) << "the last whole log stays";
    FrameLog("empty.csv").finish();
    EXPECT_EQ(read("empty.csv"), telemetry::csvHeader() + "\n");
}

} // namespace
} // namespace gnomon::viewer
