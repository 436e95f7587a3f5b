// Moving the camera: what must hold from any pose, for models of any size.
#include "core/random.h"
#include "path/framing.h"
#include "tests/support/random_point.h"
#include "viewer/input/camera_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gnomon::viewer {
namespace {

/// A control over a box of a random size somewhere, in a random pose.
CameraControl randomControl(Random& random) {
    const double size = std::exp2(random.uniform(-10, 10));
    const glm::dvec3 middle = randomPoint(random, 100 * size);
    const glm::dvec3 from = randomPoint(random, 3 * size);
    CameraControl control({middle + from, middle, {0, 1, 0}, random.uniform(0.3, 1.5)}, {0, 1, 0});
    const double yaw = random.uniform(-4, 4);
    const double pitch = random.uniform(-1, 1);
    control.look(yaw, pitch);
    return control;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

/// Lets a glide come to its end.
void settle(CameraControl& control) {
    for (int i = 0; i < 100 && control.isMoving(); ++i)
        control.advance({}, 0.02);
    EXPECT_FALSE(control.isMoving());
}

TEST(CameraControl, StartsWhereItIsToldAndJumpsWhereItIsTold) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        CameraControl control = randomControl(random);
        const Camera before = control.camera();
        const double scale = glm::length(before.target - before.eye);
        control.look(1, 0.2);
        control.jumpTo(before);
        expectNear(control.camera().eye, before.eye, 1e-9 * scale);
        expectNear(control.camera().target, before.target, 1e-6 * scale);
    }
}

TEST(CameraControl, FliesAsFarInManyShortFramesAsInOneLongOne) {
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        CameraControl once = randomControl(random);
        CameraControl often = once;
        const Flight flight{glm::normalize(randomPoint(random, 1)), random.uniform(0.2, 5)};
        const glm::dvec3 start = once.camera().eye;
        once.advance(flight, 0.1);
        for (int k = 0; k < 10; ++k)
            often.advance(flight, 0.01);
        const double way = glm::length(once.camera().eye - start);
        EXPECT_GT(way, 0);
        expectNear(often.camera().eye, once.camera().eye, 1e-9 * way + 1e-9 * glm::length(start));
    }
}

TEST(CameraControl, FliesWhereItLooks) {
    CameraControl control({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1}, {0, 1, 0});
    control.advance({{0, 0, 1}, 1}, 0.1);
    EXPECT_LT(control.camera().eye.z, 5);
    expectNear(glm::normalize(control.camera().target - control.camera().eye), {0, 0, -1}, 1e-12);
    const double z = control.camera().eye.z;
    control.look(std::numbers::pi / 2, 0);
    CameraControl sideways = control;
    sideways.advance({{0, 0, 1}, 1}, 0.1);
    EXPECT_GT(sideways.camera().eye.x, 0);
    EXPECT_NEAR(sideways.camera().eye.z, z, 0.5);
}

TEST(CameraControl, ComesToRestSoonAfterTheKeyIsLetGo) {
    Random random(3);
    CameraControl control = randomControl(random);
    for (int i = 0; i < 30; ++i)
        control.advance({{0, 0, 1}, 1}, 1.0 / 60);
    EXPECT_TRUE(control.isMoving());
    for (int i = 0; i < 60; ++i)
        control.advance({}, 1.0 / 60);
    EXPECT_FALSE(control.isMoving());
}

TEST(CameraControl, NeverTipsOver) {
    Random random(4);
    CameraControl control = randomControl(random);
    for (int i = 0; i < 2000; ++i) {
        const double yaw = random.uniform(-1, 1);
        control.look(yaw, random.uniform(-1, 1));
        EXPECT_GT(cameraBasis(control.camera()).up.y, 0);
    }
}

TEST(CameraControl, OrbitKeepsThePivotInItsPlaceOnTheScreen) {
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        CameraControl control = randomControl(random);
        const Camera before = control.camera();
        const double scale = glm::length(before.target - before.eye);
        const glm::dvec3 pivot = before.target + randomPoint(random, scale * 0.3);
        const glm::dvec3 seen = toCamera(cameraBasis(before), pivot - before.eye);
        const double yaw = random.uniform(-2, 2);
        control.orbit(pivot, yaw, random.uniform(-2, 2));
        const Camera after = control.camera();
        expectNear(toCamera(cameraBasis(after), pivot - after.eye), seen, 1e-6 * scale);
    }
}

TEST(CameraControl, FocusLooksAtThePointFromHalfAsFar) {
    Random random(6);
    for (int i = 0; i < 100; ++i) {
        CameraControl control = randomControl(random);
        const Camera before = control.camera();
        const glm::dvec3 point = before.target + randomPoint(random, 0.3 * glm::length(before.target - before.eye));
        const double distance = glm::length(point - before.eye);
        control.focusOn(point);
        settle(control);
        const Camera after = control.camera();
        EXPECT_NEAR(glm::length(point - after.eye), distance / 2, 1e-6 * distance);
        if (std::abs(glm::normalize(point - before.eye).y) < 0.999) expectNear(after.target, point, 1e-5 * distance);
    }
}

/// Where a camera with parallel lines of sight shows `point`: from the middle, in halves of the picture's height.
glm::dvec2 shownAt(const Camera& camera, const glm::dvec3& point) {
    return glm::dvec2(toCamera(cameraBasis(camera), point - camera.eye)) / halfHeightAtTarget(camera);
}

TEST(CameraControl, ParallelLinesOfSightKeepThePivotAndTheSizeOfAll) {
    Random random(9);
    for (int i = 0; i < 200; ++i) {
        CameraControl control = randomControl(random);
        control.toggleProjection();
        const Camera before = control.camera();
        const double half = halfHeightAtTarget(before);
        const glm::dvec3 point = before.target + randomPoint(random, half);
        const glm::dvec2 place = shownAt(before, point);
        control.orbit(point, random.uniform(-1, 1), random.uniform(-0.5, 0.5));
        EXPECT_NEAR(halfHeightAtTarget(control.camera()), half, 1e-9 * half);
        EXPECT_LT(glm::distance(shownAt(control.camera(), point), place), 1e-6);
        const double notches = random.uniform(-8, 8);
        control.zoomTo(point, notches);
        EXPECT_NEAR(halfHeightAtTarget(control.camera()), half * std::exp2(-notches / 5), 1e-6 * half);
        EXPECT_LT(glm::distance(shownAt(control.camera(), point), place), 1e-6);
        const double zoomed = halfHeightAtTarget(control.camera());
        control.focusOn(point);
        settle(control);
        EXPECT_NEAR(halfHeightAtTarget(control.camera()), zoomed / 2, 1e-6 * zoomed);
        EXPECT_LT(glm::length(shownAt(control.camera(), point)), 1e-6);
    }
}

TEST(CameraControl, AFlightEndsAGlide) {
    Random random(7);
    CameraControl control = randomControl(random);
    control.goTo({{0, 0, -9}, {0, 0, 0}, {0, 1, 0}, 1});
    control.advance({}, 0.05);
    control.advance({{1, 0, 0}, 1}, 0.05);
    const glm::dvec3 view = cameraBasis(control.camera()).view;
    control.advance({{1, 0, 0}, 1}, 0.05);
    expectNear(cameraBasis(control.camera()).view, view, 1e-12);
}

// Whatever is up, a glide ends at the very camera that frames a side, but for the thousandth by which it keeps off the
// poles; and the world's up stays what it was.
TEST(CameraControl, GlidesToTheCameraOfAnySideOfAnyWorld) {
    Random random(8);
    for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), {0, 0, 1}, {-1, 0, 0}, {0.3, -0.5, 0.2}})
        for (const auto& [side, word] : path::kViewSides) {
            std::vector<glm::dvec3> points;
            points.reserve(20);
            for (int i = 0; i < 20; ++i)
                points.push_back(glm::dvec3(10, 20, 30) + randomPoint(random, 4));
            const Camera home = path::framingCamera(points, path::vantageOf({}, up), 1, 0.9);
            const Camera wanted = path::framingCamera(points, path::vantageOf(side, up), 1, 0.9);
            CameraControl control(home, up);
            control.look(2, 0.5);
            control.goTo(wanted);
            settle(control);
            const CameraBasis is = cameraBasis(control.camera());
            const CameraBasis be = cameraBasis(wanted);
            expectNear(control.camera().eye, wanted.eye, 1e-9);
            expectNear(is.view, be.view, 2e-3);
            expectNear(is.up, be.up, 2e-3);
            expectNear(control.camera().up, glm::normalize(up), 1e-12);
            control.jumpTo(home);
            expectNear(control.camera().target, home.target, 1e-9);
            CameraControl fromThere(wanted, up);
            expectNear(fromThere.camera().up, glm::normalize(up), 1e-12);
            expectNear(cameraBasis(fromThere.camera()).up, be.up, 2e-3);
        }
}

TEST(CameraControl, SpeedSuitsTheDistanceOfWhatIsInViewAtAnyScale) {
    CameraControl control({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1}, {0, 1, 0});
    for (const double scale : {1e-6, 1.0, 1e6}) {
        for (int i = 0; i < 400; ++i)
            control.see({scale, 100 * scale}, 1.0 / 60);
        EXPECT_NEAR(control.speed(), 5 * scale, 0.01 * scale);
    }
    const double before = control.speed();
    control.changeSpeed(4);
    EXPECT_NEAR(control.speed(), 2 * before, 1e-9 * before);
    control.see({0, 0}, 1); // nothing in view changes nothing
    EXPECT_NEAR(control.speed(), 2 * before, 1e-9 * before);
}

} // namespace
} // namespace gnomon::viewer
