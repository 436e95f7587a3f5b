// Camera files and paths: what is no path is told with its place, and what lies between keyframes is a camera.
#include "core/error.h"
#include "core/file.h"
#include "path/camera_path.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include <unistd.h>

namespace gnomon::path {
namespace {

/// A file of `text` that lives as long as this.
class TemporaryText {
public:
    explicit TemporaryText(const std::string& text)
        : path_(testing::TempDir() + "gnomon_camera_path_" + std::to_string(::getpid()) + ".json") {
        writeTextFile(path_, text);
    }

    ~TemporaryText() { std::filesystem::remove(path_); }

    TemporaryText(const TemporaryText&) = delete;
    TemporaryText& operator=(const TemporaryText&) = delete;
    TemporaryText(TemporaryText&&) = delete;
    TemporaryText& operator=(TemporaryText&&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string path_;
};

/// A path of one keyframe behind `members`.
std::string pathWith(const std::string& members) {
    std::string text = "{";
    text += members;
    text += R"("keyframes": [{"time": 0, "eye": [0, 0, 1], "target": [0, 0, 0]}]})";
    return text;
}

TEST(CameraPath, WhatIsNoneIsToldWithThePath) {
    for (const char* part :
         {R"("loop": "yes")",
          R"("loop": 1)",
          R"("loop": null)",
          R"("interpolation": 3)",
          R"("interpolation": "cubic")",
          R"("interpolation": null)"}) {
        const TemporaryText file(pathWith(std::string(part) + ", "));
        try {
            readCameraPath(file.path());
            ADD_FAILURE() << part << " was taken";
        } catch (const Error& error) { // any other exception has no place
            EXPECT_NE(std::string(error.what()).find(file.path()), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("expected"), std::string::npos) << error.what();
        }
    }
    const TemporaryText plain(pathWith(""));
    EXPECT_FALSE(readCameraPath(plain.path()).loop);
    const TemporaryText both(pathWith(R"("loop": true, "interpolation": "catmull-rom", )"));
    EXPECT_TRUE(readCameraPath(both.path()).loop);
    EXPECT_EQ(readCameraPath(both.path()).interpolation, Interpolation::CatmullRom);
}

TEST(CameraPath, TheAngleStaysBetweenItsKeyframes) {
    constexpr double kRadiansPerDegree = std::numbers::pi / 180;
    CameraPath path;
    path.interpolation = Interpolation::CatmullRom;
    const std::vector<double> degrees = {5, 175, 175, 5, 5, 90};
    for (std::size_t i = 0; i < degrees.size(); ++i)
        path.keyframes.push_back(
            {static_cast<double>(i), {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, degrees[i] * kRadiansPerDegree}});
    for (int step = 0; step <= 500; ++step) {
        const double time = step / 100.0;
        const auto before = std::min(static_cast<std::size_t>(time), degrees.size() - 2);
        const double angle = cameraAt(path, time).fovYRadians / kRadiansPerDegree;
        EXPECT_GE(angle, std::min(degrees[before], degrees[before + 1]) - 1e-9) << time;
        EXPECT_LE(angle, std::max(degrees[before], degrees[before + 1]) + 1e-9) << time;
    }
}

TEST(CameraPath, AnAngleIsWrittenAsItWasGiven) {
    for (int tenths = 1; tenths < 1800; ++tenths) {
        const double degrees = tenths / 10.0;
        CameraPath path;
        path.keyframes = {{0, {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, degrees * (std::numbers::pi / 180)}}};
        const std::string text = toJson(path);
        const TemporaryText file(text);
        EXPECT_EQ(toJson(readCameraPath(file.path())), text);
        const std::size_t at = text.find("\"fov_y\": ") + 9;
        EXPECT_EQ(std::stod(text.substr(at)), degrees) << text.substr(at, 24);
        EXPECT_LE(text.find_first_of(",\n}", at) - at, 5U) << text.substr(at, 24);
    }
}

/// A closed path of uneven times, whose last keyframe is its first.
CameraPath loop(Interpolation interpolation) {
    CameraPath path;
    path.loop = true;
    path.interpolation = interpolation;
    const std::vector<double> times = {2, 3, 4.5, 5, 7, 8};
    const std::vector<glm::dvec3> eyes = {{0, 0, 5}, {4, 1, 1}, {2, 3, -4}, {-3, 0, -3}, {-4, 1, 2}, {0, 0, 5}};
    for (std::size_t i = 0; i < times.size(); ++i)
        path.keyframes.push_back(keyframeAt(times[i], eyes[i], {0, 0.1 * static_cast<double>(i % 5), 0}));
    return path;
}

TEST(CameraPath, ALoopHasNoKinkAtItsSeam) {
    const CameraPath path = loop(Interpolation::CatmullRom);
    const auto eye = [&](double time) { return cameraAt(path, time).eye; };
    constexpr double kStep = 1e-6;
    for (const double seam : {2.0, 8.0, 14.0}) {
        const glm::dvec3 before = (eye(seam) - eye(seam - kStep)) / kStep;
        const glm::dvec3 after = (eye(seam + kStep) - eye(seam)) / kStep;
        EXPECT_LT(glm::length(after - before), 1e-3) << "at " << seam;
        EXPECT_GT(glm::length(after), 0.5);
    }
    // The same keyframes begun elsewhere are the same curve.
    CameraPath turned = path;
    turned.keyframes.erase(turned.keyframes.begin());
    turned.keyframes.push_back({path.keyframes[1].time + path.duration(), path.keyframes[1].camera});
    for (double time = 2; time < 8; time += 0.05)
        EXPECT_LT(glm::length(cameraAt(turned, time).eye - eye(time)), 1e-9) << time;
}

TEST(CameraPath, AnOpenPathKeepsItsEnds) {
    CameraPath path = loop(Interpolation::CatmullRom);
    path.loop = false;
    path.keyframes.back().camera.eye = {1, 1, 9};
    EXPECT_EQ(cameraAt(path, 1).eye, path.keyframes.front().camera.eye);
    EXPECT_EQ(cameraAt(path, 9).eye, path.keyframes.back().camera.eye);
    EXPECT_EQ(frameTime(path, 0, 5), 2);
    EXPECT_EQ(frameTime(path, 4, 5), 8);
    EXPECT_EQ(frameTime(path, 0, 1), 2);
}

TEST(CameraPath, FramesOfALoopAreEvenAndNoneComesTwice) {
    for (const Interpolation interpolation : {Interpolation::Linear, Interpolation::CatmullRom})
        for (const int frames : {1, 2, 5, 12}) {
            const CameraPath path = loop(interpolation);
            for (int frame = 0; frame < frames; ++frame)
                EXPECT_NEAR(frameTime(path, frame, frames), 2 + 6.0 * frame / frames, 1e-12);
            if (frames == 1) continue;
            const glm::dvec3 first = cameraAt(path, frameTime(path, 0, frames)).eye;
            const glm::dvec3 last = cameraAt(path, frameTime(path, frames - 1, frames)).eye;
            EXPECT_GT(glm::length(first - last), 0.1);
        }
}

} // namespace
} // namespace gnomon::path
