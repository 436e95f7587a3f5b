// When the window draws, against what a person at rest may expect of it.
#include "viewer/redraw_scheduler.h"

#include <gtest/gtest.h>

namespace gnomon::viewer {
namespace {

telemetry::FrameRow rowOf(std::int64_t pagesMissing, std::int64_t bytesRead) {
    telemetry::FrameRow row;
    row.pagesMissing = pagesMissing;
    row.bytesRead = bytesRead;
    return row;
}

/// Draws until the scene sleeps or `max` frames are drawn; how many there were.
template <class RowOf>
int framesUntilRest(RedrawScheduler& scheduler, int max, const RowOf& rowOfFrame) {
    int frames = 0;
    while (scheduler.needsScene() && frames < max) {
        scheduler.countScene();
        scheduler.update(rowOfFrame(frames++));
    }
    return frames;
}

TEST(RedrawScheduler, TheSceneComesToRestAfterAChangeAndTellsWhichFrameIsTheLast) {
    RedrawScheduler scheduler;
    const auto complete = [](int /*frame*/) { return rowOf(0, 1000); };
    const int first = framesUntilRest(scheduler, 1000, complete);
    EXPECT_LT(first, 1000);
    scheduler.requestScene();
    int frames = 0;
    for (; !scheduler.isLastOfScene(); ++frames)
        scheduler.countScene();
    EXPECT_EQ(frames + 1, first);
    scheduler.countScene();
    EXPECT_FALSE(scheduler.needsScene());
    scheduler.countScene();
    EXPECT_FALSE(scheduler.needsScene());
}

TEST(RedrawScheduler, SettlesAfterSoManyFramesOrWhereItHurriesAfterAThirdOfASecondOfThem) {
    RedrawScheduler scheduler;
    telemetry::FrameRow row = rowOf(0, 1000);
    row.totalMs = 40;
    int frames = 0;
    for (; !scheduler.isSettled(true); ++frames) {
        EXPECT_FALSE(scheduler.isSettled(false));
        scheduler.countScene();
        scheduler.update(row);
    }
    EXPECT_EQ(frames, 8);
    scheduler.settle();
    EXPECT_TRUE(scheduler.isLastOfScene());
    scheduler.countScene();
    scheduler.settle();
    EXPECT_FALSE(scheduler.needsScene()) << "nothing is drawn for it";
    scheduler.requestScene();
    EXPECT_FALSE(scheduler.isSettled(true)) << "all begins anew";
    for (frames = 0; !scheduler.isSettled(false); ++frames)
        scheduler.countScene();
    EXPECT_TRUE(scheduler.isLastOfScene()) << "the last frame takes its time";
}

TEST(RedrawScheduler, PagesOnTheirWayKeepTheSceneAwakeUntilTheyAreThereOrNoneHasComeForLong) {
    const auto arriving = [](int frame) { return rowOf(frame < 300 ? 1 : 0, frame); };
    RedrawScheduler scheduler;
    EXPECT_GE(framesUntilRest(scheduler, 1000, arriving), 300);
    EXPECT_FALSE(scheduler.needsScene());
    const auto lost = [](int /*frame*/) { return rowOf(1, 5); };
    scheduler.requestScene();
    const int frames = framesUntilRest(scheduler, 1000, lost);
    EXPECT_GE(frames, 60);
    EXPECT_LT(frames, 100);
}

TEST(RedrawScheduler, WhatLiesOverTheSceneIsDrawnSeveralTimesAfterAChangeAndStopsWithoutOne) {
    RedrawScheduler scheduler;
    int frames = 0;
    for (; scheduler.needsOverlay(); ++frames)
        scheduler.countOverlay();
    EXPECT_GE(frames, 2); // Dear ImGui lays out in the first what it shows in the second
    EXPECT_LT(frames, 10);
    scheduler.countOverlay();
    EXPECT_FALSE(scheduler.needsOverlay());
    scheduler.keepOverlay();
    EXPECT_TRUE(scheduler.needsOverlay());
    scheduler.countOverlay();
    EXPECT_FALSE(scheduler.needsOverlay());
}

TEST(RedrawScheduler, ASceneThatCannotBeDrawnSleepsUntilSomethingChanges) {
    RedrawScheduler scheduler;
    scheduler.stopScene();
    EXPECT_FALSE(scheduler.needsScene());
    scheduler.requestScene();
    EXPECT_TRUE(scheduler.needsScene());
}

} // namespace
} // namespace gnomon::viewer
