// The shadow predicate: tests with integers whether a triangle lies between a point and the light. The result does not
// depend on the search that found the triangle.
#pragma once

#include "core/integer_light.h"

#include <array>
#include <cstdint>

namespace gnomon::exact {

/// Number of bits in the weights of a point within its triangle.
constexpr int kWeightBits = 24;

/// The corners of a triangle, in grid cells from the frame's origin. Absolute coordinates are below 2^31, edges below
/// 2^32.
using Corners = std::array<glm::i64vec3, 3>;

/// A point strictly within a triangle: corner 0 + (second * edge to corner 1 + third * edge to corner 2) / 2^24. Both
/// weights are at least 1, and their sum is below 2^24.
struct PointOnTriangle {
    Corners corners{};
    std::uint32_t second = 1;
    std::uint32_t third = 1;
};

/// Returns the coordinates of the point times 2^24, which are integers.
glm::i64vec3 scaledPoint(const PointOnTriangle& point);

/// Returns the sign of the dot product n . direction, with n = (B - A) x (C - A). The sign tells which side of the
/// triangle faces the light. It is 0 if the light direction is parallel to the triangle's plane.
int facing(const Corners& corners, const IntegerLight& light);

/// Returns the tolerance of two grid steps along `light`, as an argument of `intersect`. A triangle within the
/// tolerance casts no shadow.
std::uint32_t twoSteps(const IntegerLight& light);

/// Returns the sign of n . (eye - A), which tells which side of the triangle is visible. `scaledEye` is in units of
/// 2^-24 cells. The result is 0 if the eye lies in the plane.
int visibleSide(const Corners& corners, const glm::i64vec3& scaledEye);

/// Returns true if scaledPoint / 2^24 lies in the plane of the triangle. No ray from this point then hits the triangle.
bool isInPlane(const Corners& corners, const glm::i64vec3& scaledPoint);

/// The intersection of a triangle with the ray from a point towards the light.
enum class Hit : std::uint8_t {
    None,            // the triangle is beside the ray or behind the point, or its plane contains the point
    WithinTolerance, // ahead, but within the tolerance
    Ahead,           // ahead, farther than the tolerance: the triangle casts a shadow on the point
};

struct RayHit {
    Hit kind = Hit::None;
    /// True: the ray hits an edge or a corner, and the rule for ties assigned the hit to the triangle.
    bool isOnEdge = false;
};

/// Intersects `caster` with the ray from scaledPoint / 2^24 along the light. `tolerance` is in units of 2^-24 of the
/// light's direction, and below 2^31. The result for a triangle within the tolerance is WithinTolerance.
///
/// The sign of E . (A - P) with E = (B - A) x L tells on which side of edge AB the ray passes. If it is 0, the code
/// uses minus the sign of the first non-zero component of E. This corresponds to moving P by (e, e^2, e^3) (simulation
/// of simplicity, Edelsbrunner and Mücke 1990). Triangles that share an edge see it with opposite signs, so a ray
/// through the edge hits exactly one of them. A triangle whose plane is parallel to the light has no hit. All products
/// are below 2^121.
RayHit intersect(
    const Corners& caster, const IntegerLight& light, const glm::i64vec3& scaledPoint, std::uint32_t tolerance);

} // namespace gnomon::exact
