// Keys and drags against what the help says of them.
#include "core/random.h"
#include "viewer/input/section_drag.h"
#include "viewer/input/steering.h"
#include "viewer/panel/texel_plot.h"

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

TEST(SectionDrag, KeepsWhatWasTakenHoldOfUnderTheCursor) {
    constexpr int kSide = 600;
    Random random(5);
    const Box bounds{{-2, -3, -4}, {2, 3, 4}};
    int moved = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const auto within = [&](double max) {
            return glm::dvec3(random.uniform(-max, max), random.uniform(-max, max), random.uniform(-max, max));
        };
        Camera camera{12.0 * glm::normalize(within(1)), within(0.5), {0, 1, 0}, 1};
        std::vector<settings::Section> sections = {{within(1), within(2)}, {within(1), within(2)}};
        const std::size_t aimed = random.below(2);
        const glm::dvec3 normal = glm::normalize(sections[aimed].normal);
        glm::dvec3 grip = sections[aimed].point + glm::cross(normal, within(1)); // on the plane
        SectionDrag section;
        DragScene scene{pixelOf(camera, grip, kSide), kSide, [&](const glm::ivec2&) { return std::optional(grip); }};
        const std::vector<settings::Section> before = sections;
        const Drag begin = dragBy(GLFW_MOUSE_BUTTON_LEFT, {0, 0}, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT);
        ASSERT_EQ(useOf(begin), DragUse::Section);
        section.drag(begin, scene, camera, {kSide, kSide}, bounds, sections);
        EXPECT_EQ(section.held(), aimed) << trial;
        // The cursor goes where the grip is to be, along the normal, in steps.
        const double way = random.uniform(-1, 1);
        const glm::dvec2 start = scene.cursor;
        for (int step = 1; step <= 4; ++step) {
            const glm::dvec2 next = pixelOf(camera, grip + normal * (way * step / 4), kSide);
            const Drag on = dragBy(GLFW_MOUSE_BUTTON_LEFT, next - scene.cursor, begin.modifiers, false);
            scene.cursor = next;
            section.drag(on, scene, camera, {kSide, kSide}, bounds, sections);
        }
        EXPECT_EQ(sections[1 - aimed], before[1 - aimed]);
        const bool isSeenAhead = glm::length(scene.cursor - start) < 12;
        if (isSeenAhead) continue;
        ++moved;
        EXPECT_NEAR(glm::length(sections[aimed].point - before[aimed].point - normal * way), 0, 1e-6) << trial;
    }
    EXPECT_GT(moved, 150);
}

TEST(SectionDrag, ABoxCutsNothingOffAndStaysWithinReach) {
    const Box bounds{{-2, -3, -4}, {2, 3, 5}};
    std::vector<settings::Section> sections = sectionBox(bounds);
    ASSERT_EQ(sections.size(), settings::kMaxSections);
    for (const settings::Section& section : sections) {
        EXPECT_GT(glm::dot(section.normal, section.point), glm::dot(glm::abs(section.normal), bounds.extent()) * 0.4);
        EXPECT_EQ(sectionInWords(section, bounds).find("section: "), 0U);
    }
    const Camera camera{{0, 0, 20}, {0, 0, 0}, {0, 1, 0}, 1};
    SectionDrag drag;
    DragScene scene{{300, 300}, 600, [](const glm::ivec2&) { return std::optional(glm::dvec3(2, 0, 0)); }};
    const Drag begin = dragBy(GLFW_MOUSE_BUTTON_LEFT, {0, 0}, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT);
    drag.drag(begin, scene, camera, {600, 600}, bounds, sections);
    scene.cursor.x -= 400;
    drag.drag(
        dragBy(GLFW_MOUSE_BUTTON_LEFT, {-400, 0}, begin.modifiers, false), scene, camera, {600, 600}, bounds, sections);
    EXPECT_EQ(sections[drag.held()].normal, glm::dvec3(1, 0, 0));
    EXPECT_NEAR(sections[drag.held()].point.x, -2.04, 1e-9);
    EXPECT_EQ(sectionInWords(sections[drag.held()], bounds), "section: 0 of 4 left");
}

} // namespace
} // namespace gnomon::viewer
