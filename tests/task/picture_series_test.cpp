// Names and streams of series of pictures; tests/cli/series_test.py draws some.
#include "core/angle.h"
#include "core/random.h"
#include "path/camera_path.h"
#include "render/picture_series.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::task {
namespace {

TEST(NumberedName, HasItsNumberInOnePlace) {
    using render::numberedName;
    EXPECT_EQ(numberedName("frame%04d.png", 7), "frame0007.png");
    EXPECT_EQ(numberedName("a/%d", 12345), "a/12345");
    EXPECT_EQ(numberedName("%02d.png", 123), "123.png");
    for (const char* bad :
         {"frame.png", "", "%", "%04", "%s", "%%d", "%d%d", "%4d", "%00d", "%010d", "%0d", "%-4d", "%n"})
        EXPECT_EQ(numberedName(bad, 1), std::nullopt) << bad;
}

// Black, white and grey have no colour, and each channel stays in the range of video.
TEST(Y4m, IsInTheRangeOfVideo) {
    EXPECT_EQ(render::y4mHeader(4, 2, 29.97), "YUV4MPEG2 W4 H2 F29970:1000 Ip A1:1 C444 XCOLORRANGE=LIMITED\n");
    render::Picture picture(256, 3);
    for (int i = 0; i < 256; ++i) {
        const auto level = static_cast<std::uint8_t>(i);
        picture.at(i, 0) = {level, level, level};
        picture.at(i, 1) = {level, 0, 255};
        picture.at(i, 2) = {255, level, 0};
    }
    const std::string frame = render::y4mFrame(picture);
    const auto at = [&](int plane, int y, int x) {
        return static_cast<int>(static_cast<unsigned char>(
            frame
                [6 + (static_cast<std::size_t>(plane) * 3 + static_cast<std::size_t>(y)) * 256 +
                 static_cast<std::size_t>(x)]));
    };
    ASSERT_EQ(frame.size(), 6U + 3 * 3 * 256);
    EXPECT_EQ(at(0, 0, 0), 16);
    EXPECT_EQ(at(0, 0, 255), 235);
    for (int i = 0; i < 256; ++i) {
        EXPECT_EQ(at(1, 0, i), 128);
        EXPECT_EQ(at(2, 0, i), 128);
        for (int y = 0; y < 3; ++y) {
            EXPECT_TRUE(at(0, y, i) >= 16 && at(0, y, i) <= 235);
            for (const int plane : {1, 2})
                EXPECT_TRUE(at(plane, y, i) >= 16 && at(plane, y, i) <= 240);
        }
    }
}

TEST(TurnedAround, KeepsDistanceAndHeightAndComesBack) {
    Random random(1);
    const auto vector = [&] { return glm::dvec3(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)); };
    for (int trial = 0; trial < 200; ++trial) {
        Camera camera;
        camera.eye = vector();
        camera.target = vector();
        camera.up = vector();
        const glm::dvec3 up = glm::normalize(camera.up);
        const Camera turned = path::turnedAround(camera, camera.up, random.uniform(-7, 7));
        EXPECT_NEAR(glm::distance(turned.eye, turned.target), glm::distance(camera.eye, camera.target), 1e-9);
        EXPECT_NEAR(glm::dot(turned.eye - camera.eye, up), 0, 1e-9);
        EXPECT_EQ(turned.target, camera.target);
        EXPECT_EQ(turned.up, camera.up);
        EXPECT_LT(glm::distance(path::turnedAround(camera, camera.up, 2 * kPi).eye, camera.eye), 1e-9);
        const Camera half = path::turnedAround(camera, camera.up, kPi);
        const glm::dvec3 level = half.eye + camera.eye - 2.0 * camera.target;
        EXPECT_LT(glm::length(level - up * glm::dot(up, level)), 1e-9) << "on the other side";
    }
    Camera camera;
    camera.eye = {0, 1, 1};
    camera.target = {0, 0, 0};
    camera.up = {0, 0, -1}; // as of a view from the top
    EXPECT_LT(glm::distance(path::turnedAround(camera, {0, 1, 0}, kPi / 2).up, glm::dvec3(-1, 0, 0)), 1e-12);
    camera.up = {0, 1, 0};
    EXPECT_LT(glm::distance(path::turnedAround(camera, camera.up, kPi / 2).eye, glm::dvec3(1, 1, 0)), 1e-12);
}

} // namespace
} // namespace gnomon::task
