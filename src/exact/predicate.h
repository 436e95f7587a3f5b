// The exact shadow test of one triangle and one point: computes with integers whether the triangle lies between the
// point and the light.
#pragma once

#include "core/integer_light.h"

#include <array>
#include <cstdint>

namespace gnomon::exact {

/// Number of bits of the barycentric weights of a point on a triangle.
constexpr int kWeightBits = 24;

/// The corners of a triangle, in grid cells from the frame's origin. Absolute coordinates are below 2^31, and edge
/// vectors are below 2^32.
using Corners = std::array<glm::i64vec3, 3>;

/// A point strictly inside a triangle: corner 0 + (second * edge to corner 1 + third * edge to corner 2) / 2^24. Both
/// weights are at least 1, and their sum is below 2^24.
struct PointOnTriangle {
    Corners corners{};
    std::uint32_t second = 1;
    std::uint32_t third = 1;
};

/// Returns the coordinates of `point` times 2^24, which are integers.
glm::i64vec3 scaledPoint(const PointOnTriangle& point);

/// Returns which side of the triangle faces the light: the sign of n . direction, with n = (B - A) x (C - A). The sign
/// is 0 if the light direction is parallel to the triangle's plane.
int facing(const Corners& corners, const IntegerLight& light);

/// Returns the distance of two grid steps along `light`, in the units of the argument `tolerance` of `intersect`. A
/// triangle nearer to a point than this distance casts no shadow on the point.
std::uint32_t twoSteps(const IntegerLight& light);

/// Returns which side of the triangle the eye sees: the sign of n . (eye - A). The sign is 0 if the eye lies in the
/// triangle's plane. `scaledEye` is in units of 2^-24 cells.
int visibleSide(const Corners& corners, const glm::i64vec3& scaledEye);

/// Returns true if the point scaledPoint / 2^24 lies in the plane of the triangle. No ray from this point then hits the
/// triangle.
bool isInPlane(const Corners& corners, const glm::i64vec3& scaledPoint);

/// The result of intersecting a triangle with the ray from a point to the light.
enum class Hit : std::uint8_t {
    None,            // the triangle is beside the ray or behind the point, or its plane contains the point
    WithinTolerance, // ahead, but within the tolerance
    Ahead,           // ahead, farther than the tolerance: the triangle casts a shadow on the point
};

struct RayHit {
    Hit kind = Hit::None;
    /// True if the ray hits an edge or a corner of the triangle, and the rule for ties assigned the hit to this
    /// triangle.
    bool isOnEdge = false;
};

/// Intersects triangle `caster` with the ray from the point scaledPoint / 2^24 to a directional light. `tolerance` is
/// in units of 2^-24 of the light's direction, and below 2^31. A triangle nearer than the tolerance gives
/// Hit::WithinTolerance.
///
/// The sign of E . (A - P) with E = (B - A) x L tells on which side of edge AB the ray passes. If the sign is 0, the
/// code uses minus the sign of the first non-zero component of E. This corresponds to moving P by (e, e^2, e^3)
/// (simulation of simplicity, Edelsbrunner and Mücke 1990). Two triangles that share an edge have opposite signs for
/// it, so a ray through the edge hits exactly one of them. A triangle whose plane is parallel to the light has no hit.
/// All products are below 2^121.
RayHit intersect(
    const Corners& caster, const IntegerLight& light, const glm::i64vec3& scaledPoint, std::uint32_t tolerance);

} // namespace gnomon::exact
