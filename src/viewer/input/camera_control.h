// Converts user input to a camera: flying, looking, orbiting, and gliding to a target. It has no window and no clock.
#pragma once

#include "core/camera.h"

#include <optional>

namespace gnomon::viewer {

/// The direction of flight: right, up and forward in camera axes, each from -1 to 1.
struct Flight {
    glm::dvec3 direction{0};
    double haste = 1; // factor of the speed
};

/// The depths of the visible scene in world units.
struct SceneDepths {
    double near = 0; // above 0
    double far = 0;  // at least near
};

/// A camera that the user moves. `camera().up` is the up axis of the world, and the view never tips over it.
class CameraControl {
public:
    /// Starts at `home`. The up axis of the world is `home.up`. If the view direction of `home` is parallel to
    /// `home.up` or to `up`, the up axis is `up` instead (any length above 0). Throws Error if `home` is invalid.
    CameraControl(const Camera& home, const glm::dvec3& up);

    Camera camera() const;

    /// Moves the camera for `seconds`: along `flight` with some inertia, or along the current glide. A flight ends the
    /// glide. With parallel projection a forward flight enlarges the image. Times above 0.1 s count as 0.1 s, so that a
    /// slow frame does not move the camera far.
    void advance(const Flight& flight, double seconds);

    /// Returns true if `advance` without a flight would move the camera.
    bool isMoving() const;

    /// Turns the view: yaw to the right and pitch upwards, in radians.
    void look(double yawRadians, double pitchRadians);

    /// Turns the camera about `pivot`. The pivot stays at its place on the screen. With parallel projection the scale
    /// does not change.
    void orbit(const glm::dvec3& pivot, double yawRadians, double pitchRadians);

    /// Moves the camera to the right and up, in world units.
    void shift(double right, double up);

    /// Moves the camera towards `point`, which stays at its place on the screen. Five notches halve the distance.
    /// Negative notches double it.
    void zoomTo(const glm::dvec3& point, double notches);

    /// Glides to a view of `point` from half the distance.
    void focusOn(const glm::dvec3& point);

    /// Glides to `camera`. The up axis does not change, unless `camera` looks along it.
    void goTo(const Camera& camera);

    /// Jumps to `camera`. The up axis does not change, unless `camera` looks along it.
    void jumpTo(const Camera& camera);

    /// Switches between perspective and parallel projection. Objects at the distance of the target do not change their
    /// size.
    void toggleProjection();

    /// Adapts the speed to the visible depths. The speed follows them within some tenths of a second. `seconds` is the
    /// time since the last call.
    void see(const SceneDepths& depths, double seconds);

    /// Processes the wheel: four notches double the speed.
    void changeSpeed(double notches);

    /// Returns the speed at haste 1 in world units per second: half the geometric mean of the visible depths per
    /// second, times the factor of the wheel.
    double speed() const;

    /// Returns the estimated distance of the object that the user looks at: from the last focus, or from the visible
    /// depths.
    double distance() const { return pose_.distance; }

private:
    /// A camera position with angles in the frame of `right_`, `up_` and `front_`.
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
