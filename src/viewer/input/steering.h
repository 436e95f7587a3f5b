// From keys and mouse to the camera and the light: which keys fly where, and what each drag turns.
#pragma once

#include "settings/settings.h"
#include "viewer/input/camera_control.h"
#include "viewer/input/input.h"

#include <functional>
#include <optional>

namespace gnomon::viewer {

/// Where the keys fly for which `isHeld` (of a key of GLFW's) is true: Shift hastens, Ctrl slows down.
Flight heldFlight(const std::function<bool(int key)>& isHeld);

/// The direction towards the light after a drag by `moved` pixels: the light moves over the pad of the window's panel,
/// on the side of the horizon that it is on.
glm::dvec3 turnedLight(const Camera& camera, const glm::dvec3& towardsLight, const glm::dvec2& moved);

/// Asks for the light after such a drag.
void turnLight(settings::Settings& asked, const Camera& camera, const glm::dvec2& moved);

/// What is under the cursor during a drag.
struct DragScene {
    glm::dvec2 cursor{0};                                                   // pixels of the picture
    int pictureHeight = 1;                                                  // pixels
    std::function<std::optional<glm::dvec3>(const glm::ivec2& pixel)> pick; // the world point under a pixel
};

/// What a drag does.
enum class DragUse : std::uint8_t { Orbit, Look, Pan, Light, Section };

/// Left: orbits; middle, or Shift with the left: pans; right, or Alt with the left: looks around; Ctrl with the left:
/// turns the light; Ctrl and Shift with the left: moves a section.
DragUse useOf(const Drag& drag);

/// Moves towards what is under the cursor, or ahead where nothing is; with Ctrl it changes the flying speed and returns
/// what to say of it.
std::string turnWheel(double notches, bool withControl, const DragScene& scene, CameraControl& control);

/// The drags that move a camera: about what was under the cursor when they began, sideways, around.
class Steering {
public:
    void drag(const Drag& drag, const DragScene& scene, CameraControl& control);

private:
    std::optional<glm::dvec3> pivot_; // of the orbit at hand
};

} // namespace gnomon::viewer
