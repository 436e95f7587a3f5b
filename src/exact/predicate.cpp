#include "exact/predicate.h"

#include <cmath>

namespace gnomon::exact {

namespace {

__extension__ using Wide = __int128; // wide enough for each product below

struct WideVector {
    Wide x = 0;
    Wide y = 0;
    Wide z = 0;
};

WideVector cross(const glm::i64vec3& a, const glm::i64vec3& b) {
    return {Wide{a.y} * b.z - Wide{a.z} * b.y, Wide{a.z} * b.x - Wide{a.x} * b.z, Wide{a.x} * b.y - Wide{a.y} * b.x};
}

Wide dot(const WideVector& a, const glm::i64vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

int signOf(Wide value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

WideVector normalOf(const Corners& corners) {
    return cross(corners[1] - corners[0], corners[2] - corners[0]);
}

constexpr std::int64_t kScale = std::int64_t{1} << kWeightBits;

/// Tells on which side of a triangle edge the ray to the light passes: 1 or -1, or 0 if the edge is parallel to the
/// light.
struct EdgeSide {
    int sign = 0;
    bool isOnEdge = false;
};

EdgeSide sideOf(const glm::i64vec3& a, const glm::i64vec3& b, const IntegerLight& light, const glm::i64vec3& point) {
    const WideVector e = cross(b - a, light.direction);
    const int sign = signOf(dot(e, a * kScale - point));
    if (sign != 0) return {sign, false};
    const Wide first = e.x != 0 ? e.x : e.y != 0 ? e.y : e.z;
    return {-signOf(first), true};
}

} // namespace

glm::i64vec3 scaledPoint(const PointOnTriangle& point) {
    const auto& [a, b, c] = point.corners;
    return a * kScale + (b - a) * std::int64_t{point.second} + (c - a) * std::int64_t{point.third};
}

int facing(const Corners& corners, const IntegerLight& light) {
    return signOf(dot(normalOf(corners), light.direction));
}

std::uint32_t twoSteps(const IntegerLight& light) {
    constexpr double kSteps = 2;
    return static_cast<std::uint32_t>(
        std::floor(kSteps * std::ldexp(1.0, kLightBits) / glm::length(glm::dvec3(light.direction))));
}

int visibleSide(const Corners& corners, const glm::i64vec3& scaledEye) {
    return signOf(dot(normalOf(corners), scaledEye - corners[0] * kScale));
}

bool isInPlane(const Corners& corners, const glm::i64vec3& scaledPoint) {
    return dot(normalOf(corners), corners[0] * kScale - scaledPoint) == 0;
}

RayHit intersect(
    const Corners& caster, const IntegerLight& light, const glm::i64vec3& scaledPoint, std::uint32_t tolerance) {
    const WideVector normal = normalOf(caster);
    const Wide towards = dot(normal, light.direction);
    if (towards == 0) return {};
    const EdgeSide first = sideOf(caster[0], caster[1], light, scaledPoint);
    const EdgeSide second = sideOf(caster[1], caster[2], light, scaledPoint);
    if (first.sign != second.sign) return {};
    const EdgeSide third = sideOf(caster[2], caster[0], light, scaledPoint);
    if (first.sign != third.sign) return {};
    // Height of the triangle's plane above the point along the light direction, multiplied by the factor `towards`.
    const Wide height = dot(normal, caster[0] * kScale - scaledPoint);
    const Wide ahead = towards > 0 ? height : -height;
    if (ahead <= 0) return {};
    const Wide size = towards > 0 ? towards : -towards;
    const bool isOnEdge = first.isOnEdge || second.isOnEdge || third.isOnEdge;
    return {ahead > size * tolerance ? Hit::Ahead : Hit::WithinTolerance, isOnEdge};
}

} // namespace gnomon::exact
