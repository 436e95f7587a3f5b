// Keys and drags against what the help says of them.
#include "core/random.h"
#include "viewer/input/steering.h"
#include "viewer/panel/storage_pad.h"

#include <gtest/gtest.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cmath>
#include <set>

namespace gnomon::viewer {
namespace {

Flight flightWith(const std::set<int>& held) {
    return heldFlight([&](int key) { return held.count(key) > 0; });
}

CameraControl control() {
    return {{{0, 1, 8}, {0, 0, 0}, {0, 1, 0}, 1}, {0, 1, 0}};
}

Drag dragBy(int button, const glm::dvec2& moved, int modifiers = 0, bool hasBegun = true) {
    return {button, modifiers, moved, hasBegun};
}

/// Where `point` is in a square picture of `side` pixels.
glm::dvec2 pixelOf(const Camera& camera, const glm::dvec3& point, double side) {
    const glm::dvec3 p = toCamera(cameraBasis(camera), point - camera.eye);
    const double focal = side / 2 / std::tan(camera.fovYRadians / 2);
    return {side / 2 + focal * p.x / p.z, side / 2 - focal * p.y / p.z};
}

TEST(HeldFlight, AddsUpAndShiftAndCtrlCancel) {
    EXPECT_EQ(flightWith({GLFW_KEY_W}).direction, glm::dvec3(0, 0, 1));
    EXPECT_EQ(flightWith({GLFW_KEY_A, GLFW_KEY_E}).direction, glm::dvec3(-1, 1, 0));
    EXPECT_EQ(flightWith({GLFW_KEY_S, GLFW_KEY_D, GLFW_KEY_Q}).direction, glm::dvec3(1, -1, -1));
    EXPECT_EQ(flightWith({GLFW_KEY_W, GLFW_KEY_S, GLFW_KEY_N}).direction, glm::dvec3(0));
    EXPECT_GT(flightWith({GLFW_KEY_W, GLFW_KEY_RIGHT_SHIFT}).haste, 1);
    EXPECT_LT(flightWith({GLFW_KEY_W, GLFW_KEY_LEFT_CONTROL}).haste, 1);
    EXPECT_EQ(flightWith({GLFW_KEY_LEFT_SHIFT, GLFW_KEY_LEFT_CONTROL}).haste, 1);
}

TEST(TurnedLight, StaysOnItsSideOfTheHorizonAndComesBack) {
    Random random(1);
    const Camera camera = control().camera();
    for (int i = 0; i < 200; ++i) {
        const double x = random.uniform(-0.6, 0.6);
        const double z = random.uniform(-0.6, 0.6);
        const glm::dvec3 light = glm::normalize(glm::dvec3(x, i % 2 == 0 ? 1 : -1, z));
        const double right = random.uniform(-40, 40);
        const glm::dvec2 moved(right, random.uniform(-40, 40));
        const glm::dvec3 turned = turnedLight(camera, light, moved);
        EXPECT_GT(turned.y * light.y, 0);
        EXPECT_LE(glm::length(turnedLight(camera, turned, -moved) - light), 1e-9);
        EXPECT_GT(turnedLight(camera, light, moved * 1e4).y * light.y, 0);
    }
}

TEST(Steering, AMiddleDragKeepsWhatIsLookedAtUnderTheCursor) {
    CameraControl hand = control();
    const Camera before = hand.camera();
    const glm::dvec3 ahead = before.eye + glm::normalize(before.target - before.eye) * hand.distance();
    Steering().drag(dragBy(GLFW_MOUSE_BUTTON_MIDDLE, {30, -20}), {{0, 0}, 600, {}}, hand);
    const glm::dvec2 moved = pixelOf(hand.camera(), ahead, 600) - pixelOf(before, ahead, 600);
    EXPECT_NEAR(moved.x, 30, 1e-6);
    EXPECT_NEAR(moved.y, -20, 1e-6);
}

TEST(Steering, AnOrbitKeepsThePointThatWasUnderTheCursorWhenItBegan) {
    CameraControl hand = control();
    Steering steering;
    int picks = 0;
    const glm::dvec3 pivot(0.5, 0.25, 1);
    DragScene scene{{10, 20}, 600, [&](const glm::ivec2& pixel) -> std::optional<glm::dvec3> {
                        ++picks;
                        EXPECT_EQ(pixel, glm::ivec2(10, 20));
                        return pivot;
                    }};
    const Camera before = hand.camera();
    steering.drag(dragBy(GLFW_MOUSE_BUTTON_LEFT, {5, 5}), scene, hand);
    for (int i = 0; i < 20; ++i)
        steering.drag(dragBy(GLFW_MOUSE_BUTTON_LEFT, {9, -3}, 0, false), scene, hand);
    EXPECT_EQ(picks, 1);
    EXPECT_NEAR(glm::length(hand.camera().eye - pivot), glm::length(before.eye - pivot), 1e-9);
    EXPECT_LE(glm::length(pixelOf(hand.camera(), pivot, 600) - pixelOf(before, pivot, 600)), 1e-6);
    steering.drag(dragBy(GLFW_MOUSE_BUTTON_LEFT, {5, 5}), scene, hand);
    EXPECT_EQ(picks, 2);
}

TEST(Steering, AnOrbitOfNothingGoesAboutTheTarget) {
    CameraControl hand = control();
    const glm::dvec3 target = hand.camera().target;
    const double distance = glm::length(hand.camera().eye - target);
    const DragScene scene{{0, 0}, 600, [](const glm::ivec2&) { return std::optional<glm::dvec3>(); }};
    Steering().drag(dragBy(GLFW_MOUSE_BUTTON_LEFT, {50, 0}), scene, hand);
    EXPECT_NEAR(glm::length(hand.camera().eye - target), distance, 1e-9);
}

TEST(Steering, ButtonsAndKeysSayWhatADragDoes) {
    const auto use = [](int button, int modifiers) { return useOf(dragBy(button, {1, 1}, modifiers)); };
    EXPECT_EQ(use(GLFW_MOUSE_BUTTON_LEFT, 0), DragUse::Orbit);
    EXPECT_EQ(use(GLFW_MOUSE_BUTTON_LEFT, GLFW_MOD_SHIFT), DragUse::Pan);
    EXPECT_EQ(use(GLFW_MOUSE_BUTTON_LEFT, GLFW_MOD_CONTROL), DragUse::Light);
    EXPECT_EQ(use(GLFW_MOUSE_BUTTON_LEFT, GLFW_MOD_ALT), DragUse::Look);
    EXPECT_EQ(use(GLFW_MOUSE_BUTTON_MIDDLE, 0), DragUse::Pan);
    EXPECT_EQ(use(GLFW_MOUSE_BUTTON_RIGHT, 0), DragUse::Look);
}

TEST(Wheel, GoesTowardsWhatIsUnderTheCursorAndBack) {
    const glm::dvec3 point(1, 0.5, 2);
    const DragScene scene{{10, 20}, 600, [&](const glm::ivec2&) { return std::optional(point); }};
    CameraControl hand = control();
    const Camera before = hand.camera();
    EXPECT_EQ(turnWheel(5, false, scene, hand), "");
    EXPECT_NEAR(glm::distance(hand.camera().eye, point), glm::distance(before.eye, point) / 2, 1e-9);
    EXPECT_LE(glm::length(pixelOf(hand.camera(), point, 600) - pixelOf(before, point, 600)), 1e-6);
    turnWheel(-5, false, scene, hand);
    EXPECT_LE(glm::distance(hand.camera().eye, before.eye), 1e-9);
    const DragScene nothing{{10, 20}, 600, [](const glm::ivec2&) { return std::optional<glm::dvec3>(); }};
    turnWheel(1, false, nothing, hand);
    EXPECT_GT(glm::dot(hand.camera().eye - before.eye, before.target - before.eye), 0);
    const double speed = hand.speed();
    EXPECT_NE(turnWheel(4, true, scene, hand).find("speed: "), std::string::npos);
    EXPECT_GT(hand.speed(), speed);
}

TEST(Steering, APressByItselfChangesNoCamera) {
    for (const int button : {GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_MIDDLE, GLFW_MOUSE_BUTTON_RIGHT})
        for (const bool isParallel : {false, true}) {
            CameraControl pressed = control();
            if (isParallel) pressed.toggleProjection();
            const Camera before = pressed.camera();
            Steering steering;
            const DragScene scene{{5, 5}, 10, [](const glm::ivec2&) { return glm::dvec3(1, 1, 1); }};
            steering.drag(dragBy(button, {0, 0}), scene, pressed);
            EXPECT_EQ(pressed.camera().eye, before.eye);
            EXPECT_EQ(pressed.camera().target, before.target);
            steering.drag(dragBy(button, {7, 3}, 0, false), scene, pressed);
            EXPECT_NE(pressed.camera().target, before.target);
        }
}

} // namespace
} // namespace gnomon::viewer
