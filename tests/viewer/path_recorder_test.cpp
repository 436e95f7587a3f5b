// Paths made by hand: what is recorded is walked again, by the clock and at a bench's fixed step.
#include "core/random.h"
#include "viewer/path_recorder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::viewer {
namespace {

Camera cameraOfTime(double t) {
    return {{std::sin(t), t, std::cos(t)}, {std::sin(t) + 1, t, 0}, {0, 1, 0}, 1};
}

TEST(PathRecorder, KeepsAtMostThirtyKeyframesASecondAndTheWayBetweenThem) {
    Random random(1);
    PathRecorder recorder;
    double t = 100;
    const double start = t;
    while (t < start + 4) {
        recorder.add(t, cameraOfTime(t));
        t += random.uniform(0.001, 0.05);
    }
    const path::CameraPath path = *recorder.path();
    EXPECT_EQ(path.keyframes.front().time, 0);
    EXPECT_LE(path.keyframes.size(), 4 * 30 + 2U);
    for (double at = 0; at < path.duration(); at += 0.0137)
        EXPECT_LE(glm::length(path::cameraAt(path, at).eye - cameraOfTime(start + at).eye), 1e-3);
}

TEST(PathRecorder, ACameraThatStandsStillTakesTwoKeyframesAndDoesNotDrift) {
    PathRecorder recorder;
    for (int i = 0; i < 300; ++i)
        recorder.add(i * 0.02, cameraOfTime(0));
    for (int i = 300; i < 310; ++i)
        recorder.add(i * 0.02, cameraOfTime(i * 0.02));
    const path::CameraPath path = *recorder.path();
    EXPECT_LE(path.keyframes.size(), 12U);
    EXPECT_EQ(path::cameraAt(path, 5.9).eye, cameraOfTime(0).eye);
}

TEST(PathRecorder, NothingRecordedIsNoPath) {
    EXPECT_FALSE(PathRecorder().path());
}

TEST(PathPlayer, AtAFixedStepShowsTheCamerasOfABench) {
    PathRecorder recorder;
    for (int i = 0; i < 100; ++i)
        recorder.add(i * 0.04, cameraOfTime(i * 0.04));
    const path::CameraPath path = *recorder.path();
    for (const int frames : {1, 2, 7, 60}) {
        PathPlayer player(path, frames);
        int drawn = 0;
        do {
            EXPECT_EQ(player.frame(), drawn);
            EXPECT_EQ(player.camera().eye, path::cameraAt(path, path::frameTime(path, drawn, frames)).eye);
            ++drawn;
        } while (player.advance(123.0)); // the clock does not count
        EXPECT_EQ(drawn, frames);
    }
}

TEST(PathPlayer, ByTheClockTakesAsLongAsTheRecording) {
    PathRecorder recorder;
    for (int i = 0; i <= 100; ++i)
        recorder.add(7 + i * 0.05, cameraOfTime(i * 0.05));
    PathPlayer player(*recorder.path(), std::nullopt);
    double seconds = 0;
    while (player.advance(0.016))
        seconds += 0.016;
    EXPECT_NEAR(seconds, 5, 0.04);
    EXPECT_NEAR(player.part(), 1, 1e-9);
}

} // namespace
} // namespace gnomon::viewer
