// When the window draws, against what a person at rest may expect of it.
#include "viewer/pace.h"

#include <gtest/gtest.h>

namespace gnomon::viewer {
namespace {

telemetry::FrameRow rowOf(std::int64_t pagesMissing, std::int64_t bytesRead) {
    telemetry::FrameRow row;
    row.pagesMissing = pagesMissing;
    row.bytesRead = bytesRead;
    return row;
}

/// Draws until the scene sleeps or `most` frames are drawn; how many there were.
template <class RowOf>
int framesUntilRest(Pace& pace, int most, const RowOf& rowOfFrame) {
    int frames = 0;
    while (pace.isSceneAwake() && frames < most) {
        pace.countScene();
        pace.see(rowOfFrame(frames++));
    }
    return frames;
}

TEST(Pace, TheSceneComesToRestAfterAChangeAndTellsWhichFrameIsTheLast) {
    Pace pace;
    const auto complete = [](int /*frame*/) { return rowOf(0, 1000); };
    const int first = framesUntilRest(pace, 1000, complete);
    EXPECT_LT(first, 1000);
    pace.wakeScene();
    int frames = 0;
    for (; !pace.isLastOfScene(); ++frames)
        pace.countScene();
    EXPECT_EQ(frames + 1, first);
    pace.countScene();
    EXPECT_FALSE(pace.isSceneAwake());
    pace.countScene();
    EXPECT_FALSE(pace.isSceneAwake());
}

TEST(Pace, SettlesAfterSoManyFramesOrWhereItHurriesAfterAThirdOfASecondOfThem) {
    Pace pace;
    telemetry::FrameRow row = rowOf(0, 1000);
    row.totalMs = 40;
    int frames = 0;
    for (; !pace.isSettled(true); ++frames) {
        EXPECT_FALSE(pace.isSettled(false));
        pace.countScene();
        pace.see(row);
    }
    EXPECT_EQ(frames, 8);
    pace.settle();
    EXPECT_TRUE(pace.isLastOfScene());
    pace.countScene();
    pace.settle();
    EXPECT_FALSE(pace.isSceneAwake()) << "nothing is drawn for it";
    pace.wakeScene();
    EXPECT_FALSE(pace.isSettled(true)) << "all begins anew";
    for (frames = 0; !pace.isSettled(false); ++frames)
        pace.countScene();
    EXPECT_TRUE(pace.isLastOfScene()) << "the last frame takes its time";
}

TEST(Pace, PagesOnTheirWayKeepTheSceneAwakeUntilTheyAreThereOrNoneHasComeForLong) {
    const auto arriving = [](int frame) { return rowOf(frame < 300 ? 1 : 0, frame); };
    Pace pace;
    EXPECT_GE(framesUntilRest(pace, 1000, arriving), 300);
    EXPECT_FALSE(pace.isSceneAwake());
    const auto lost = [](int /*frame*/) { return rowOf(1, 5); };
    pace.wakeScene();
    const int frames = framesUntilRest(pace, 1000, lost);
    EXPECT_GE(frames, 60);
    EXPECT_LT(frames, 100);
}

TEST(Pace, WhatLiesOverTheSceneIsDrawnSeveralTimesAfterAChangeAndStopsWithoutOne) {
    Pace pace;
    int frames = 0;
    for (; pace.isWindowAwake(); ++frames)
        pace.countWindow();
    EXPECT_GE(frames, 2); // Dear ImGui lays out in the first what it shows in the second
    EXPECT_LT(frames, 10);
    pace.countWindow();
    EXPECT_FALSE(pace.isWindowAwake());
    pace.keepWindow();
    EXPECT_TRUE(pace.isWindowAwake());
    pace.countWindow();
    EXPECT_FALSE(pace.isWindowAwake());
}

TEST(Pace, ASceneThatCannotBeDrawnSleepsUntilSomethingChanges) {
    Pace pace;
    pace.stopScene();
    EXPECT_FALSE(pace.isSceneAwake());
    pace.wakeScene();
    EXPECT_TRUE(pace.isSceneAwake());
}

} // namespace
} // namespace gnomon::viewer
