#include "viewer/input/steering.h"

#include "core/formatted.h"
#include "viewer/input/key_table.h"
#include "viewer/panel/texel_plot.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

namespace gnomon::viewer {

namespace {

constexpr double kRadiansPerPixel = 0.004;
constexpr double kLightPerPixel = 1.0 / 300; // in radii of the light widget
constexpr double kMaxRadius = 0.985;         // in radii of the light widget; a light on the horizon would be ambiguous
constexpr double kHaste = 5;                 // factor of the speed with Shift, and its inverse with Ctrl

glm::dvec3 directionOf(Way way) {
    switch (way) {
    case Way::Forward:
        return {0, 0, 1};
    case Way::Back:
        return {0, 0, -1};
    case Way::Left:
        return {-1, 0, 0};
    case Way::Right:
        return {1, 0, 0};
    case Way::Down:
        return {0, -1, 0};
    case Way::Up:
        return {0, 1, 0};
    }
    return glm::dvec3(0);
}

} // namespace

Flight heldFlight(const std::function<bool(int key)>& isHeld) {
    Flight flight;
    for (const Binding& binding : bindings())
        if (binding.action == Action::Fly && isHeld(binding.key))
            flight.direction += directionOf(static_cast<Way>(binding.value));
    if (isHeld(GLFW_KEY_LEFT_SHIFT) || isHeld(GLFW_KEY_RIGHT_SHIFT)) flight.haste *= kHaste;
    if (isHeld(GLFW_KEY_LEFT_CONTROL) || isHeld(GLFW_KEY_RIGHT_CONTROL)) flight.haste /= kHaste;
    return flight;
}

glm::dvec3 turnedLight(const Camera& camera, const glm::dvec3& towardsLight, const glm::dvec2& moved) {
    const LightDisc disc = lightDisc(camera, glm::dot(towardsLight, camera.up) < 0);
    glm::dvec2 point = disc.point(towardsLight) + glm::dvec2(moved.x, -moved.y) * kLightPerPixel;
    if (glm::length(point) > kMaxRadius) point *= kMaxRadius / glm::length(point);
    return disc.direction(point);
}

void turnLight(settings::Settings& asked, const Camera& camera, const glm::dvec2& moved) {
    asked.towardsLight = turnedLight(camera, asked.towardsLight, moved);
    asked.isLightGiven = true;
    asked.lightAt = std::nullopt;
    asked.sun = std::nullopt;
    asked.north = std::nullopt;
}

std::string turnWheel(double notches, bool withControl, const DragScene& scene, CameraControl& control) {
    if (withControl) {
        control.changeSpeed(notches);
        return formatted("speed: %.3g a second", control.speed());
    }
    const Camera camera = control.camera();
    const glm::dvec3 ahead = camera.eye + glm::normalize(camera.target - camera.eye) * control.distance();
    control.zoomTo(scene.pick(glm::ivec2(scene.cursor)).value_or(ahead), notches);
    return {};
}

DragUse useOf(const Drag& drag) {
    if (drag.button == GLFW_MOUSE_BUTTON_MIDDLE) return DragUse::Pan;
    if (drag.button == GLFW_MOUSE_BUTTON_RIGHT) return DragUse::Look;
    const bool withShift = (drag.modifiers & GLFW_MOD_SHIFT) != 0;
    if ((drag.modifiers & GLFW_MOD_CONTROL) != 0) return withShift ? DragUse::Section : DragUse::Light;
    if (withShift) return DragUse::Pan;
    return (drag.modifiers & GLFW_MOD_ALT) != 0 ? DragUse::Look : DragUse::Orbit;
}

void Steering::drag(const Drag& drag, const DragScene& scene, CameraControl& control) {
    const glm::dvec2 angle = drag.moved * kRadiansPerPixel;
    const DragUse use = useOf(drag);
    if (use == DragUse::Pan) {
        // The panning keeps points at the distance of the last focus under the cursor.
        const double high = 2 * std::tan(control.camera().fovYRadians / 2) * control.distance();
        const double perPixel = high / std::max(scene.pictureHeight, 1);
        return control.shift(-drag.moved.x * perPixel, drag.moved.y * perPixel);
    }
    if (use == DragUse::Look) return control.look(angle.x, -angle.y);
    if (drag.hasBegun || !pivot_) pivot_ = scene.pick(glm::ivec2(scene.cursor)).value_or(control.camera().target);
    if (drag.moved != glm::dvec2(0)) control.orbit(*pivot_, angle.x, -angle.y);
}

} // namespace gnomon::viewer
