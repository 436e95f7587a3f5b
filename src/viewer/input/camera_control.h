// Moves a camera by user input: flying, looking around, orbiting, and gliding to a target. It needs no window and no
// clock.
#pragma once

#include "core/camera.h"

#include <optional>

namespace gnomon::viewer {

/// The direction of a camera flight: right, up and forward in camera axes, each from -1 to 1.
struct Flight {
    glm::dvec3 direction{0};
    double haste = 1; // factor of the speed
};

/// The nearest and the farthest view depth of the visible scene, in world units.
struct SceneDepths {
    double near = 0; // above 0
    double far = 0;  // at least near
};

/// A camera that the user moves. Its up direction is the one of the world, and the view never tips over this axis.
class CameraControl {
public:
    /// Starts with the camera `home`. The up direction of the world is `home.up`. If the view direction of `home` is
    /// parallel to `home.up` or to `up`, it is `up` instead (any length above 0). Throws Error if `home` is invalid.
    CameraControl(const Camera& home, const glm::dvec3& up);

    Camera camera() const;

    /// Moves the camera for `seconds`: along `flight` with some inertia, or along the current glide to a target. A
    /// flight ends the glide. With parallel projection a forward flight enlarges the image. Times above 0.1 s count as
    /// 0.1 s, so that a slow frame does not move the camera far.
    void advance(const Flight& flight, double seconds);

    /// Returns true if the camera still moves without a flight by the user.
    bool isMoving() const;

    /// Turns the view direction about the eye: yaw to the right and pitch upwards, in radians.
    void look(double yawRadians, double pitchRadians);

    /// Orbits the camera about `pivot`, by angles in radians. The pivot stays at its position on the screen. With
    /// parallel projection the scale does not change.
    void orbit(const glm::dvec3& pivot, double yawRadians, double pitchRadians);

    /// Moves the camera sideways by `right` and vertically by `up`, in world units.
    void shift(double right, double up);

    /// Moves the camera towards `point`, which stays at its position on the screen. Five notches of the mouse wheel
    /// halve the distance to it. Five negative notches double it.
    void zoomTo(const glm::dvec3& point, double notches);

    /// Starts a glide to a view of `point` from half the present distance.
    void focusOn(const glm::dvec3& point);

    /// Starts a glide to `camera`. The up direction does not change, unless `camera` looks along it.
    void goTo(const Camera& camera);

    /// Moves the camera to `camera` at once. The up direction does not change, unless `camera` looks along it.
    void jumpTo(const Camera& camera);

    /// Switches between perspective and parallel projection. Objects at the distance of the target do not change their
    /// size on the screen.
    void toggleProjection();

    /// Adapts the flying speed to the visible depths, within some tenths of a second. `seconds` is the time since the
    /// last call.
    void see(const SceneDepths& depths, double seconds);

    /// Changes the flying speed by notches of the mouse wheel. Four notches double it.
    void changeSpeed(double notches);

    /// Returns the flying speed without the factor `haste`, in world units per second. It is half the geometric mean of
    /// the visible depths per second, times the factor of the mouse wheel.
    double speed() const;

    /// Returns the estimated distance of the object that the user looks at. It comes from the last focus, or from the
    /// visible depths.
    double distance() const { return pose_.distance; }

private:
    /// The position of a camera and its angles relative to the axes `right_`, `up_` and `front_`.
    struct Pose {
        glm::dvec3 eye{0};
        double yaw = 0;   // 0 looks along front_, pi/2 along right_
        double pitch = 0; // above the horizon
        double distance = 1;
    };

    struct Glide {
        Pose from;
        Pose to;
        double seconds = 0; // since the start of the glide
    };

    Pose poseOf(const Camera& camera) const;
    glm::dvec3 direction(const Pose& pose) const;
    void glideTo(const Pose& pose);

    glm::dvec3 right_{1, 0, 0};
    glm::dvec3 up_{0, 1, 0};
    glm::dvec3 front_{0, 0, -1};
    double fovYRadians_ = 1;
    Projection projection_ = Projection::Perspective;
    Pose pose_;
    std::optional<Glide> glide_;
    glm::dvec3 velocity_{0}; // in camera axes, in units of speed()
    double sceneDistance_ = 1;
    double notches_ = 0;
};

} // namespace gnomon::viewer
