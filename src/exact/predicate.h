// Whether a triangle stands between a point and the light, in integers: what is true of a shadow, whoever finds it.
#pragma once

#include "core/integer_light.h"

#include <array>
#include <cstdint>

namespace gnomon::exact {

/// The bits of the weights of a point within its triangle.
constexpr int kWeightBits = 24;

/// Corners of a triangle: grid cells from the frame's origin, each coordinate below 2^31 in size and each edge below
/// 2^32.
using Corners = std::array<glm::i64vec3, 3>;

/// A point strictly within a triangle: corner 0 + (second * edge to corner 1 + third * edge to corner 2) / 2^24. Both
/// weights are at least 1, and their sum is below 2^24.
struct PointOnTriangle {
    Corners corners{};
    std::uint32_t second = 1;
    std::uint32_t third = 1;
};

/// The point times 2^24: whole numbers.
glm::i64vec3 scaledPoint(const PointOnTriangle& point);

/// The sign of n . direction with n = (B - A) x (C - A): on which side of the triangle the light stands; 0 in its
/// plane.
int facing(const Corners& corners, const IntegerLight& light);

/// How far ahead along `light` a triangle may lie and still only touch: two grid steps, as `meet` takes it.
std::uint32_t twoSteps(const IntegerLight& light);

/// The sign of n . (eye - A) for the eye in 2^-24 cells: which side is seen; 0 from within the plane.
int seenSide(const Corners& corners, const glm::i64vec3& scaledEye);

/// Whether scaledPoint / 2^24 lies in the plane of the triangle, which no ray from there meets ahead.
bool isInPlane(const Corners& corners, const glm::i64vec3& scaledPoint);

/// Where a triangle meets the ray from a point towards the light.
enum class Meeting : std::uint8_t {
    None,     // beside the ray, behind the point or in its very plane
    Touching, // ahead, but no farther than the tolerance
    Ahead,    // farther than that: it casts its shadow on the point
};

struct RayMeeting {
    Meeting meeting = Meeting::None;
    bool isOnEdge = false; // the ray meets an edge or a corner, and the rule for ties decided that it is the triangle's
};

/// Decides where `caster` meets the ray from scaledPoint / 2^24 along the light. `tolerance`, in 2^-24 of the light's
/// direction and below 2^31, is how far ahead a triangle may lie and still only touch.
///
/// On which side of an edge AB the ray passes is the sign of E . (A - P) with E = (B - A) x L; where that is 0, minus
/// the sign of the first component of E that is not: as if P were moved by (e, e^2, e^3) (simulation of simplicity,
/// Edelsbrunner and Mücke 1990). Triangles that share an edge see it with opposite signs, so a ray through it meets
/// just one of them. A triangle whose plane holds the light meets no ray. All products stay below 2^121.
RayMeeting meet(
    const Corners& caster, const IntegerLight& light, const glm::i64vec3& scaledPoint, std::uint32_t tolerance);

} // namespace gnomon::exact
