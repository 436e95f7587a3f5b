// Applies keys and mouse drags to the camera and the light.
#pragma once

#include "settings/settings.h"
#include "viewer/input/camera_control.h"
#include "viewer/input/input.h"

#include <functional>
#include <optional>

namespace gnomon::viewer {

/// Returns the flight of the held keys. `isHeld` takes a key code of GLFW. Shift makes the flight faster, Ctrl slower.
Flight heldFlight(const std::function<bool(int key)>& isHeld);

/// Returns the direction towards the light after a drag by `moved` pixels. The light moves like on the light widget of
/// the panel, and does not cross the horizon.
glm::dvec3 turnedLight(const Camera& camera, const glm::dvec3& towardsLight, const glm::dvec2& moved);

/// Sets the light in `asked` to the direction after a drag by `moved` pixels (see turnedLight).
void turnLight(settings::Settings& asked, const Camera& camera, const glm::dvec2& moved);

/// The cursor and the image during a drag.
struct DragScene {
    glm::dvec2 cursor{0};                                                   // pixels of the image
    int pictureHeight = 1;                                                  // pixels
    std::function<std::optional<glm::dvec3>(const glm::ivec2& pixel)> pick; // returns the world point under a pixel
};

/// The effect of a drag.
enum class DragUse : std::uint8_t { Orbit, Look, Pan, Light, Section };

/// Returns the effect of a drag: left orbits, middle or Shift + left pans, right or Alt + left looks around, Ctrl +
/// left turns the light, Ctrl + Shift + left moves a section.
DragUse useOf(const Drag& drag);

/// Moves the camera towards the point under the cursor, or forward if there is none. With Ctrl it changes the flying
/// speed and returns a message.
std::string turnWheel(double notches, bool withControl, const DragScene& scene, CameraControl& control);

/// Applies the drags that move the camera: orbit about the point under the cursor, pan, and look around.
class Steering {
public:
    void drag(const Drag& drag, const DragScene& scene, CameraControl& control);

private:
    std::optional<glm::dvec3> pivot_; // pivot of the current orbit
};

} // namespace gnomon::viewer
