// The exact shadow test of one triangle and one point for a point light, in integer arithmetic. The rules are the same
// as in predicate.h, but all rays end at the light, which is a grid point.
#pragma once

#include "exact/predicate.h"

#include <optional>

namespace gnomon::exact {

/// Number of bits for the coordinates of a point light. The coordinates are less than 2^52 cells from the frame's
/// origin.
constexpr int kPointLightBits = 52;

/// Returns which side of the triangle faces the point light at grid point `light`: 1, -1, or 0 if the light lies in the
/// triangle's plane.
int facingPoint(const Corners& corners, const glm::i64vec3& light);

/// The ray from a sample to a point light. The direction is rounded like the direction of a directional light. The
/// tolerance is two grid steps along the ray.
struct PointRay {
    IntegerLight direction;
    std::uint32_t tolerance = 0;
};

std::optional<PointRay> rayToPoint(const glm::i64vec3& light, const glm::i64vec3& scaledPoint);

/// Intersects `caster` with the segment from a sample at scaledPoint / 2^24 to a point light at the grid point `light`.
/// The light's coordinates are below 2^52 cells.
///
/// The sign of E . (A - P) with E = (B - A) x (L - A) tells on which side of edge AB the segment passes. If the sign is
/// 0, the code uses minus the sign of the first non-zero component of E. The segment passes through the triangle if all
/// three signs equal the sign of n . (L - A). If all three are opposite, the triangle lies behind the light. A triangle
/// whose plane contains the light has no hit. The triangle lies ahead if P and L are on different sides of its plane.
/// Its distance exceeds the tolerance if |n . (A - P)| > tolerance |n . G|, with the direction G and the tolerance of
/// rayToPoint. Products are below 2^146.
RayHit intersectTowards(const Corners& caster, const glm::i64vec3& light, const glm::i64vec3& scaledPoint);

/// Intersects `caster` with the segment from scaledPoint / 2^24 to `light`. `ray` is the precomputed ray of this
/// segment.
RayHit intersectTowards(
    const Corners& caster, const glm::i64vec3& light, const glm::i64vec3& scaledPoint, const PointRay& ray);

} // namespace gnomon::exact
