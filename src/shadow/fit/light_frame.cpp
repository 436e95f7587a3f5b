#include "shadow/fit/light_frame.h"

#include <cmath>

namespace gnomon::shadow {

namespace {

constexpr glm::dvec3 kView{0, 0, 1};
constexpr glm::dvec3 kUp{0, 1, 0};
constexpr double kParallel = 1e-12; // max |L x v| for which light and view direction count as parallel

} // namespace

double sinLightAngle(const glm::dvec3& towardsLight) {
    return glm::length(glm::cross(towardsLight, kView));
}

LightFrame lightFrameAlong(const glm::dvec3& towardsLight, const glm::dvec3& guide) {
    LightFrame frame;
    frame.x = glm::normalize(glm::cross(towardsLight, guide));
    frame.y = towardsLight;
    frame.z = glm::cross(frame.x, towardsLight);
    return frame;
}

LightFrame lightFrame(const glm::dvec3& towardsLight) {
    return lightFrameAlong(towardsLight, sinLightAngle(towardsLight) < kParallel ? kUp : kView);
}

LightFrame rolled(const LightFrame& frame, double radians) {
    const double c = std::cos(radians);
    const double s = std::sin(radians);
    return {frame.x * c - frame.z * s, frame.y, frame.z * c + frame.x * s};
}

glm::dvec3 alongX(const LightFrame& frame) {
    return glm::cross(frame.y, frame.z);
}

LightFrame leant(const LightFrame& frame, const glm::dvec3& side) {
    const glm::dvec3 x = alongX(frame);
    return {x - frame.z * (glm::dot(x, side) / glm::dot(frame.z, side)), frame.y, frame.z};
}

double lean(const LightFrame& frame) {
    return -glm::dot(frame.x, frame.z);
}

glm::dvec3 toLight(const LightFrame& frame, const glm::dvec3& p) {
    return {glm::dot(frame.x, p), glm::dot(frame.y, p), glm::dot(frame.z, p)};
}

glm::dvec3 toCamera(const LightFrame& frame, const glm::dvec3& p) {
    return alongX(frame) * (p.x + lean(frame) * p.z) + frame.y * p.y + frame.z * p.z;
}

} // namespace gnomon::shadow
