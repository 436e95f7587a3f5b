#include "viewer/input/camera_control.h"

#include "core/angle.h"
#include "hierarchy/upright_frame.h"

#include <algorithm>
#include <cmath>

namespace gnomon::viewer {

namespace {

constexpr double kMaxPitch = kPi / 2 - 1e-3; // the yaw is undefined along the up axis
constexpr double kLongestStep = 0.1;         // seconds
constexpr double kGlideSeconds = 0.4;
constexpr double kInertiaSeconds = 0.06;
constexpr double kSpeedSeconds = 0.3;    // response time of the speed to the visible depths
constexpr double kSpeedOfDistance = 0.5; // speed before any wheel input, in visible distances per second
constexpr double kNotchesPerOctave = 4;
constexpr double kStill = 1e-3; // max velocity, as a share of speed(), at which the camera counts as resting
constexpr double kAlong = 1e-9; // sine of the max angle between a view and an axis that count as parallel

/// Adds full turns to `angle` (radians) so that the result is as near to `reference` as possible.
double nearestTurn(double angle, double reference) {
    const double turn = 2 * kPi;
    return angle + turn * std::round((reference - angle) / turn);
}

} // namespace

CameraControl::CameraControl(const Camera& home, const glm::dvec3& up)
    : fovYRadians_(home.fovYRadians), projection_(home.projection) {
    const CameraBasis basis = cameraBasis(home);
    const auto isAcross = [&](const glm::dvec3& axis) {
        return glm::length(glm::cross(basis.view, axis)) > kAlong * glm::length(axis);
    };
    up_ = glm::normalize(isAcross(up) && isAcross(home.up) ? home.up : up);
    const hierarchy::UprightFrame frame = hierarchy::uprightFrame(up_);
    front_ = -frame.front;
    right_ = frame.right;
    pose_ = poseOf(home);
    sceneDistance_ = pose_.distance;
}

CameraControl::Pose CameraControl::poseOf(const Camera& camera) const {
    const glm::dvec3 ahead = camera.target - camera.eye;
    const double distance = glm::length(ahead);
    const glm::dvec3 to = ahead / distance;
    Pose pose;
    pose.eye = camera.eye;
    // If the camera looks straight up or down, its up vector determines the yaw.
    const double rise = glm::dot(to, up_);
    const bool isUpright = glm::length(to - rise * up_) > kAlong;
    const glm::dvec3 level = isUpright ? to : rise < 0 ? camera.up : -camera.up;
    pose.yaw = std::atan2(glm::dot(level, right_), glm::dot(level, front_));
    pose.pitch = std::clamp(std::asin(std::clamp(glm::dot(to, up_), -1.0, 1.0)), -kMaxPitch, kMaxPitch);
    pose.distance = distance;
    return pose;
}

glm::dvec3 CameraControl::direction(const Pose& pose) const {
    return (front_ * std::cos(pose.yaw) + right_ * std::sin(pose.yaw)) * std::cos(pose.pitch) +
           up_ * std::sin(pose.pitch);
}

Camera CameraControl::camera() const {
    return {pose_.eye, pose_.eye + direction(pose_) * pose_.distance, up_, fovYRadians_, projection_};
}

void CameraControl::toggleProjection() {
    projection_ = projection_ == Projection::Perspective ? Projection::Orthographic : Projection::Perspective;
}

void CameraControl::advance(const Flight& flight, double seconds) {
    const double step = std::clamp(seconds, 0.0, kLongestStep);
    const bool flies = flight.direction != glm::dvec3(0);
    if (flies) glide_.reset();
    if (glide_) {
        glide_->seconds += step;
        const double part = std::min(glide_->seconds / kGlideSeconds, 1.0);
        const double ease = part * part * (3 - 2 * part);
        pose_.eye = glm::mix(glide_->from.eye, glide_->to.eye, ease);
        pose_.yaw = glide_->from.yaw + (nearestTurn(glide_->to.yaw, glide_->from.yaw) - glide_->from.yaw) * ease;
        pose_.pitch = glide_->from.pitch + (glide_->to.pitch - glide_->from.pitch) * ease;
        pose_.distance = glide_->from.distance + (glide_->to.distance - glide_->from.distance) * ease;
        if (part >= 1) glide_.reset();
        return;
    }
    glm::dvec3 wanted = flight.direction * flight.haste;
    const double length = glm::length(flight.direction);
    if (length > 1) wanted /= length;
    // Integrates the flying velocity exactly, so that the path of the camera does not depend on the frame times.
    const double decay = std::exp(-step / kInertiaSeconds);
    const glm::dvec3 way = wanted * step + (velocity_ - wanted) * (kInertiaSeconds * (1 - decay));
    velocity_ = wanted + (velocity_ - wanted) * decay;
    if (!flies && glm::length(velocity_) < kStill) velocity_ = glm::dvec3(0);
    const CameraBasis basis = cameraBasis(camera());
    glm::dvec3 moved = way * speed();
    if (projection_ == Projection::Orthographic) {
        const double nearer = std::exp(-moved.z / pose_.distance);
        moved.z = pose_.distance * (1 - nearer);
        pose_.distance *= nearer;
    }
    pose_.eye += toWorld(basis, moved);
}

bool CameraControl::isMoving() const {
    return glide_.has_value() || velocity_ != glm::dvec3(0);
}

void CameraControl::look(double yawRadians, double pitchRadians) {
    glide_.reset();
    pose_.yaw += yawRadians;
    pose_.pitch = std::clamp(pose_.pitch + pitchRadians, -kMaxPitch, kMaxPitch);
}

void CameraControl::orbit(const glm::dvec3& pivot, double yawRadians, double pitchRadians) {
    const CameraBasis before = cameraBasis(camera());
    const glm::dvec3 toPivot = toCamera(before, pivot - pose_.eye);
    look(yawRadians, pitchRadians);
    pose_.eye = pivot - toWorld(cameraBasis(camera()), toPivot);
    if (projection_ == Projection::Perspective) pose_.distance = std::max(glm::length(pivot - pose_.eye), 1e-12);
}

void CameraControl::zoomTo(const glm::dvec3& point, double notches) {
    glide_.reset();
    const double nearer = std::exp2(-notches / 5);
    pose_.eye = point + (pose_.eye - point) * nearer;
    const bool isParallel = projection_ == Projection::Orthographic;
    pose_.distance = std::max(isParallel ? pose_.distance * nearer : glm::length(point - pose_.eye), 1e-12);
}

void CameraControl::shift(double right, double up) {
    glide_.reset();
    const CameraBasis basis = cameraBasis(camera());
    pose_.eye += basis.right * right + basis.up * up;
}

void CameraControl::focusOn(const glm::dvec3& point) {
    const glm::dvec3 ahead = point - pose_.eye;
    if (!(glm::length(ahead) > 0)) return;
    const Pose turned = poseOf({pose_.eye, point, up_, fovYRadians_});
    const double distance = 0.5 * (projection_ == Projection::Orthographic ? pose_.distance : turned.distance);
    glideTo({point - glm::normalize(ahead) * distance, turned.yaw, turned.pitch, distance});
}

void CameraControl::goTo(const Camera& camera) {
    glideTo(poseOf(camera));
}

void CameraControl::jumpTo(const Camera& camera) {
    glide_.reset();
    velocity_ = glm::dvec3(0);
    fovYRadians_ = camera.fovYRadians;
    projection_ = camera.projection;
    pose_ = poseOf(camera);
}

void CameraControl::glideTo(const Pose& pose) {
    velocity_ = glm::dvec3(0);
    glide_ = Glide{pose_, pose, 0};
}

void CameraControl::see(const SceneDepths& depths, double seconds) {
    if (!(depths.near > 0 && depths.far >= depths.near)) return;
    const double follow = 1 - std::exp(-std::clamp(seconds, 0.0, kLongestStep) / kSpeedSeconds);
    const double seen = std::sqrt(depths.near * depths.far);
    sceneDistance_ *= std::pow(seen / sceneDistance_, follow); // in ratios, because distances span orders of magnitude
}

void CameraControl::changeSpeed(double notches) {
    notches_ = std::clamp(notches_ + notches, -40.0, 40.0);
}

double CameraControl::speed() const {
    return kSpeedOfDistance * sceneDistance_ * std::exp2(notches_ / kNotchesPerOctave);
}

} // namespace gnomon::viewer
