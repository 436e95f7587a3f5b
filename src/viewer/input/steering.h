// Applies held keys and mouse drags to the camera and the light.
#pragma once

#include "settings/settings.h"
#include "viewer/input/camera_control.h"
#include "viewer/input/input.h"

#include <functional>
#include <optional>

namespace gnomon::viewer {

/// Returns the flight direction and speed for the held keys. `isHeld` takes a key code of GLFW. Shift makes the flight
/// faster, and Ctrl makes it slower.
Flight heldFlight(const std::function<bool(int key)>& isHeld);

/// Returns the direction towards the light after a mouse drag by `moved` pixels. The light moves like on the light
/// widget of the panel, and does not cross the horizon.
glm::dvec3 turnedLight(const Camera& camera, const glm::dvec3& towardsLight, const glm::dvec2& moved);

/// Turns the light of the settings `asked` by a mouse drag of `moved` pixels (see turnedLight).
void turnLight(settings::Settings& asked, const Camera& camera, const glm::dvec2& moved);

/// The cursor position and the image size, which drags and the mouse wheel need to move the camera.
struct DragScene {
    glm::dvec2 cursor{0};                                                   // pixels of the image
    int pictureHeight = 1;                                                  // pixels
    std::function<std::optional<glm::dvec3>(const glm::ivec2& pixel)> pick; // returns the world point under a pixel
};

/// The effect of a mouse drag on the camera, the light or a section plane.
enum class DragUse : std::uint8_t { Orbit, Look, Pan, Light, Section };

/// Returns the effect of a mouse drag. Left orbits, middle or Shift + left pans, and right or Alt + left looks around.
/// Ctrl + left turns the light, and Ctrl + Shift + left moves a section plane.
DragUse useOf(const Drag& drag);

/// Moves the camera towards the point under the cursor by notches of the mouse wheel, or forward if there is no point.
/// With Ctrl it changes the flying speed instead and returns a message.
std::string turnWheel(double notches, bool withControl, const DragScene& scene, CameraControl& control);

/// Moves the camera by mouse drags: orbits about the point under the cursor, pans, and looks around.
class Steering {
public:
    void drag(const Drag& drag, const DragScene& scene, CameraControl& control);

private:
    std::optional<glm::dvec3> pivot_; // pivot of the current orbit
};

} // namespace gnomon::viewer
