// Who has the camera after each key of a walk: user input, path or recorder; where it was, and what was measured there.
#include "core/error.h"
#include "core/file.h"
#include "viewer/measuring.h"
#include "viewer/recent/kept_views.h"
#include "viewer/recent/recent_views.h"
#include "viewer/walk.h"

#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

namespace gnomon::viewer {
namespace {

const Camera kHome{{0, 1, 8}, {0, 0, 0}, {0, 1, 0}, 1};
const glm::dvec3 kUp{0, 1, 0};

path::CameraPath pathAlongX() {
    path::CameraPath path;
    for (int i = 0; i <= 4; ++i) {
        Camera camera = kHome;
        camera.eye.x += i;
        camera.target.x += i;
        path.keyframes.push_back({0.5 * i, camera});
    }
    return path;
}

/// A walk with a clock that the test sets, in a folder of its own.
class WalkTest : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directories(folder_);
        std::filesystem::current_path(folder_);
    }

    void TearDown() override {
        std::filesystem::current_path(before_);
        std::filesystem::remove_all(folder_);
    }

    Walk walkWith(std::optional<path::CameraPath> path, std::optional<int> frames = std::nullopt) {
        Walk walk(
            messages, [this] { return now; }, std::move(path), frames);
        walk.enter(kHome, kUp);
        return walk;
    }

    std::string lastMessage() const { return messages.all().empty() ? "" : messages.all().back().text; }

    double now = 0;
    std::vector<std::string> told;
    Messages messages{[this] { return now; }, [this](const std::string& text) { told.push_back(text); }};
    SavedFiles saved{"model.gnm"};

private:
    std::filesystem::path before_ = std::filesystem::current_path();
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("gnomon_walk_" + std::to_string(::getpid()));
};

TEST_F(WalkTest, AFrozenEyeStaysWhileTheHandMovesOn) {
    Walk walk = walkWith(std::nullopt);
    EXPECT_EQ(walk.culledBy().eye, walk.camera().eye);
    const glm::dvec3 eye = walk.camera().eye;
    walk.toggleFreeze();
    walk.control().shift(3, 0);
    EXPECT_NE(walk.camera().eye, eye);
    EXPECT_EQ(walk.culledBy().eye, eye);
    EXPECT_TRUE(walk.isFrozen());
    walk.toggleFreeze();
    EXPECT_EQ(walk.culledBy().eye, walk.camera().eye);
}

TEST_F(WalkTest, WithoutAPathThereIsNothingToPlay) {
    Walk walk = walkWith(std::nullopt);
    EXPECT_FALSE(walk.togglePlaying(saved));
    EXPECT_FALSE(walk.isPlaying());
    EXPECT_EQ(lastMessage(), "no path yet: R records one");
    EXPECT_EQ(walk.playedPart(), -1);
}

TEST_F(WalkTest, APathHasTheCameraUntilItsEndAndTheHandGoesOnFromThere) {
    Walk walk = walkWith(pathAlongX(), 9);
    EXPECT_FALSE(walk.isUnderWay());
    ASSERT_TRUE(walk.togglePlaying(saved));
    EXPECT_TRUE(walk.isUnderWay());
    EXPECT_TRUE(walk.playsFixed());
    int frames = 1;
    for (double x = walk.camera().eye.x; walk.advance(123); ++frames, x = walk.camera().eye.x)
        EXPECT_LE(x, walk.camera().eye.x);
    EXPECT_EQ(frames, 9);
    EXPECT_FALSE(walk.isPlaying());
    EXPECT_NEAR(walk.camera().eye.x, 4, 1e-9);
    EXPECT_TRUE(walk.advance(123)); // nothing is played any more
}

TEST_F(WalkTest, APathThatIsStoppedLeavesTheHandWhereItWas) {
    Walk walk = walkWith(pathAlongX());
    ASSERT_TRUE(walk.togglePlaying(saved));
    EXPECT_FALSE(walk.playsFixed());
    ASSERT_TRUE(walk.advance(0.75));
    const glm::dvec3 eye = walk.camera().eye;
    EXPECT_GT(eye.x, 1);
    EXPECT_FALSE(walk.togglePlaying(saved));
    EXPECT_NEAR(glm::length(walk.camera().eye - eye), 0, 1e-9);
}

TEST_F(WalkTest, WhatIsRecordedIsSavedAndPlayedNext) {
    Walk walk = walkWith(std::nullopt);
    walk.toggleRecording(saved);
    EXPECT_TRUE(walk.isUnderWay());
    for (int i = 0; i < 20; ++i) {
        now += 0.1;
        walk.control().shift(0.5, 0);
        walk.record(walk.camera());
    }
    const glm::dvec3 last = walk.camera().eye;
    walk.control().goTo(kHome);
    walk.toggleRecording(saved);
    ASSERT_TRUE(walk.togglePlaying(saved));
    EXPECT_EQ(told.back(), "saved model_path1.json");
    EXPECT_TRUE(std::filesystem::exists("model_path1.json"));
    EXPECT_NEAR(glm::length(walk.camera().eye - kHome.eye), 0, 1e-6);
    ASSERT_TRUE(walk.advance(1.999));
    EXPECT_NEAR(glm::length(walk.camera().eye - last), 0, 0.05);
    walk.togglePlaying(saved);
    walk.toggleRecording(saved);
    EXPECT_TRUE(walk.togglePlaying(saved)); // which ends the recording
    EXPECT_EQ(told.back(), "saved model_path2.json");
    EXPECT_FALSE(walk.isRecording());
}

TEST_F(WalkTest, AnotherModelEndsAllButThePath) {
    Walk walk = walkWith(pathAlongX());
    walk.toggleFreeze();
    walk.togglePlaying(saved);
    walk.enter(kHome, kUp);
    EXPECT_FALSE(walk.isFrozen() || walk.isPlaying() || walk.isRecording());
    EXPECT_TRUE(walk.togglePlaying(saved));
    Camera impossible = kHome;
    impossible.target = impossible.eye;
    EXPECT_THROW(walk.enter(impossible, kUp), Error);
    EXPECT_TRUE(walk.isPlaying());
}

Camera cameraAtX(double x) {
    return {{x, 1, 8}, {x, 0, 0}, {0, 1, 0}, 1};
}

TEST(RecentViews, GoBackAndForthThroughWhereTheCameraStayed) {
    RecentViews views;
    EXPECT_FALSE(views.back() || views.forth());
    for (int x = 0; x < 4; ++x)
        views.stay(cameraAtX(x));
    views.stay(cameraAtX(3.01)); // the same but for a trifle
    EXPECT_EQ(views.back()->eye.x, 2);
    EXPECT_EQ(views.back()->eye.x, 1);
    EXPECT_EQ(views.forth()->eye.x, 2);
    views.stay(cameraAtX(2));
    EXPECT_EQ(views.forth()->eye.x, 3);
    EXPECT_FALSE(views.forth());
    views.back();
    views.stay(cameraAtX(9)); // what lay ahead is gone
    EXPECT_FALSE(views.forth());
    EXPECT_EQ(views.back()->eye.x, 2);
    Camera other = cameraAtX(2);
    other.projection = Projection::Orthographic;
    views.stay(other);
    EXPECT_EQ(views.back()->projection, Projection::Perspective);
}

TEST(RecentViews, KeepTheLastHundredOfThoseThatStoodForHalfASecond) {
    RecentViews views;
    for (int x = 0; x < 150; ++x) {
        views.see(cameraAtX(x), x);
        views.see(cameraAtX(x + 0.3), x + 0.3); // moves on
        views.see(cameraAtX(x + 0.3), x + (x % 50 == 7 ? 0.7 : 0.85));
    }
    int count = 1;
    double last = 149.3;
    for (auto camera = views.back(); camera; camera = views.back(), ++count)
        EXPECT_LT(std::exchange(last, camera->eye.x), 149.4);
    EXPECT_EQ(count, static_cast<int>(RecentViews::kMaxViews));
    EXPECT_NEAR(last, 48.3, 1e-9); // 57.3 and 107.3 went too soon
}

/// A folder that goes with what is in it.
class ViewsFolder {
public:
    ViewsFolder() { std::filesystem::remove_all(path_); }

    ~ViewsFolder() { std::filesystem::remove_all(path_); }

    ViewsFolder(const ViewsFolder&) = delete;
    ViewsFolder& operator=(const ViewsFolder&) = delete;
    ViewsFolder(ViewsFolder&&) = delete;
    ViewsFolder& operator=(ViewsFolder&&) = delete;

    std::string views() const { return (path_ / "state" / "views").string(); }

    /// Writes `text` in place of all that is kept.
    void overwrite(const std::string& text) const {
        for (const auto& entry : std::filesystem::directory_iterator(views()))
            writeTextFile(entry.path().string(), text);
    }

    std::size_t fileCount() const {
        const auto all = std::filesystem::directory_iterator(views());
        return static_cast<std::size_t>(std::distance(begin(all), end(all)));
    }

private:
    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / ("gnomon_views_" + std::to_string(::getpid()));
};

TEST(KeptViews, ComeBackInTheNextWindow) {
    const ViewsFolder folder;
    RecentViews views;
    for (int x = 0; x < 3; ++x)
        views.stay(cameraAtX(x));
    Camera parallel = cameraAtX(2);
    parallel.projection = Projection::Orthographic;
    views.stay(parallel);
    KeptViews(folder.views()).save("a.gnm", views.cameras());
    KeptViews next(folder.views());
    EXPECT_TRUE(next.load("b.gnm").empty());
    RecentViews again(next.load("./x/../a.gnm"));
    again.stay(cameraAtX(9));
    EXPECT_TRUE(again.back()->isParallel());
    EXPECT_EQ(again.back()->eye, cameraAtX(2).eye);
    EXPECT_EQ(again.back()->target, cameraAtX(1).target);
    EXPECT_EQ(RecentViews(std::vector<Camera>(130, cameraAtX(1))).cameras().size(), RecentViews::kMaxViews);
    KeptViews nowhere("");
    nowhere.save("a.gnm", views.cameras());
    EXPECT_TRUE(nowhere.load("a.gnm").empty());
}

TEST(KeptViews, TakeNothingFromWhatIsNoViews) {
    const ViewsFolder folder;
    KeptViews kept(folder.views());
    kept.save("a.gnm", {cameraAtX(1)});
    const std::string model = std::filesystem::weakly_canonical(std::filesystem::absolute("a.gnm")).string();
    for (const std::string& text :
         {std::string(),
          std::string("{}"),
          std::string("[1]"),
          std::string(R"({"model": 1, "views": []})"),
          R"({"model": ")" + model + R"(", "views": [{"eye": [0, 0, 0], "target": [0, 0, 0]}]})",
          R"({"model": ")" + model + R"(", "views": [{"eye": [0, 1e999, 0], "target": [0, 0, 0]}]})",
          std::string(KeptViews::kMaxBytes + 1, ' '),
          std::string(100000, '[')}) {
        folder.overwrite(text);
        EXPECT_THROW(kept.load("a.gnm"), Error) << text.substr(0, 80);
    }
    folder.overwrite(R"({"model": "/another", "views": [{"eye": [0, 0, 0], "target": [0, 0, 1]}]})");
    EXPECT_TRUE(kept.load("a.gnm").empty());
    KeptViews(folder.views()).save("a.gnm", {cameraAtX(4)});
    EXPECT_EQ(kept.load("a.gnm").size(), 1U);
}

TEST(KeptViews, AreOfTheLastModelsAndFailWhereNothingCanBeWritten) {
    const ViewsFolder folder;
    KeptViews kept(folder.views());
    kept.save("first.gnm", {cameraAtX(1)});
    const std::string theirs = folder.views() + "/notes.json";
    writeTextFile(theirs, "somebody's own");
    std::filesystem::last_write_time(theirs, std::filesystem::file_time_type()); // the oldest
    for (std::size_t i = 0; i < KeptViews::kMaxModels + 5; ++i)
        kept.save(std::to_string(i) + ".gnm", {cameraAtX(1)});
    EXPECT_TRUE(std::filesystem::remove(theirs)) << "it is no file of views";
    EXPECT_EQ(folder.fileCount(), KeptViews::kMaxModels);
    EXPECT_EQ(kept.load(std::to_string(KeptViews::kMaxModels + 4) + ".gnm").size(), 1U);
    EXPECT_THROW(KeptViews("/dev/null/views").save("a.gnm", {cameraAtX(1)}), Error);
}

TEST(Measuring, TakesDropsAndEndsMeasures) {
    inspect::Surveyed of;
    of.grid.stepExponent = -3;
    Measuring measuring(of);
    EXPECT_FALSE(measuring.isOn());
    measuring.toggle();
    EXPECT_TRUE(measuring.isOn());
    EXPECT_TRUE(measuring.isEmpty());
    EXPECT_FALSE(measuring.dropLast());
    EXPECT_FALSE(measuring.beginNext());
    EXPECT_EQ(measuring.inWords().size(), 1U);
    measuring.take({{0, 0, 0}, 0});
    measuring.take({{8, 0, 0}, 0});
    EXPECT_TRUE(measuring.beginNext());
    EXPECT_FALSE(measuring.beginNext());
    measuring.take({{0, 8, 0}, 0});
    EXPECT_EQ(measuring.measures().size(), 2U);
    EXPECT_EQ(measuring.inWords()[0], "measure 2");
    const std::string csv = measuring.csv();
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
    EXPECT_TRUE(measuring.dropLast());
    const std::string fewer = measuring.csv();
    EXPECT_EQ(std::count(fewer.begin(), fewer.end(), '\n'), 3);
    EXPECT_NE(measuring.json().find("\"straight\": 1.0"), std::string::npos);
    EXPECT_TRUE(measuring.dropLast()); // of the measure before, which takes points again
    EXPECT_EQ(measuring.measures().size(), 1U);
    EXPECT_TRUE(measuring.dropLast());
    EXPECT_FALSE(measuring.dropLast());
    EXPECT_TRUE(measuring.isEmpty());
}

} // namespace
} // namespace gnomon::viewer
