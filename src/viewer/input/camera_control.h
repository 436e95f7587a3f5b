// User input to camera: flying, looking, orbiting, gliding to where a key says. Knows nothing of windows or clocks.
#pragma once

#include "core/camera.h"

#include <optional>

namespace gnomon::viewer {

/// Which way to fly: right, up and forward in camera axes, each from -1 to 1.
struct Flight {
    glm::dvec3 direction{0};
    double haste = 1; // multiplies the speed
};

/// The depths of what is in view, world units.
struct SceneDepths {
    double near = 0; // above 0
    double far = 0;  // above near
};

/// A camera that is moved by hand. `camera().up` is that of the world; the view never tips over it.
class CameraControl {
public:
    /// At `home`, in a world whose up is that of `home` or, where `home` looks along `up` (of any length above 0),
    /// this. Throws Error if `home` is impossible.
    CameraControl(const Camera& home, const glm::dvec3& up);

    Camera camera() const;

    /// Moves on by `seconds`: along `flight`, with a little inertia, or along the glide that is under way, which any
    /// flight ends. Where lines of sight are parallel flying ahead comes nearer to the target, and so enlarges. Seconds
    /// above a tenth count as a tenth, so that a slow frame does not throw the eye far.
    void advance(const Flight& flight, double seconds);

    /// Whether `advance` without a flight would still move the camera.
    bool isMoving() const;

    /// Turns the view: yaw to the right, pitch upwards, radians.
    void look(double yawRadians, double pitchRadians);

    /// Turns the eye about `pivot` with everything it sees, so that the pivot keeps its place on the screen; where
    /// lines of sight are parallel all keeps its size.
    void orbit(const glm::dvec3& pivot, double yawRadians, double pitchRadians);

    /// Moves the eye sideways: right and up, world units.
    void shift(double right, double up);

    /// Moves the eye towards `point`, which keeps its place on the screen: five notches halve the way, away from it
    /// they double it.
    void zoomTo(const glm::dvec3& point, double notches);

    /// Glides to look at `point` from half as far.
    void focusOn(const glm::dvec3& point);

    /// Glides to `camera`, whose up is this one's unless it looks along that.
    void goTo(const Camera& camera);

    /// Takes over `camera` at once, likewise.
    void jumpTo(const Camera& camera);

    /// Between lines of sight that part and parallel ones; what is as far as the target keeps its size.
    void toggleProjection();

    /// What is in view now, for the speed; the speed follows within some tenths of a second.
    void see(const SceneDepths& depths, double seconds);

    /// Turns the wheel: four notches double the speed.
    void changeSpeed(double notches);

    /// World units a second at haste 1: half the geometric mean of the depths in view, times the wheel's factor.
    double speed() const;

    /// How far away what is looked at is taken to be: the last focus, or the depths in view.
    double distance() const { return pose_.distance; }

private:
    /// Angles in the frame of `right_`, `up_` and `front_`.
    struct Pose {
        glm::dvec3 eye{0};
        double yaw = 0;   // 0 looks along front_, pi/2 along right_
        double pitch = 0; // above the horizon
        double distance = 1;
    };

    struct Glide {
        Pose from;
        Pose to;
        double seconds = 0; // since it began
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
    glm::dvec3 velocity_{0}; // camera axes, in units of speed()
    double sceneDistance_ = 1;
    double notches_ = 0;
};

} // namespace gnomon::viewer
