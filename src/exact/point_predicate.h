// Whether a triangle stands between a point and a point light, in integers: the rules of predicate.h with rays that
// meet in one grid point in place of a direction.
#pragma once

#include "exact/predicate.h"

#include <optional>

namespace gnomon::exact {

/// A point light may lie so many bits of cells from the frame's origin, along each axis: less than 2^52 cells.
constexpr int kPointLightBits = 52;

/// On which side of the triangle the light at grid point `light` stands: 1, -1, or 0 in its plane.
int facingPoint(const Corners& corners, const glm::i64vec3& light);

/// The direction from scaledPoint / 2^24 to the light, rounded as that of a light far away, and the tolerance of `meet`
/// along it: two grid steps. Nothing where the point is the light.
struct PointRay {
    IntegerLight direction;
    std::uint32_t tolerance = 0;
};

std::optional<PointRay> rayToPoint(const glm::i64vec3& light, const glm::i64vec3& scaledPoint);

/// Decides where `caster` meets the way from scaledPoint / 2^24 to `light`, a grid point below 2^52 cells in size.
///
/// On which side of an edge AB the way passes is the sign of E . (A - P) with E = (B - A) x (L - A); where that is 0,
/// minus the sign of the first component of E that is not. It passes through the triangle if all three are the sign of
/// n . (L - A): were they its opposite, the triangle would lie beyond the light. A triangle whose plane holds the light
/// meets no ray. It lies ahead if P is on the other side of its plane than L, and farther ahead than the tolerance if
/// |n . (A - P)| > tolerance |n . G| with G and the tolerance of rayToPoint. Products stay below 2^146.
RayMeeting meetTowards(const Corners& caster, const glm::i64vec3& light, const glm::i64vec3& scaledPoint);

/// The same for a ray that is known already.
RayMeeting meetTowards(
    const Corners& caster, const glm::i64vec3& light, const glm::i64vec3& scaledPoint, const PointRay& ray);

} // namespace gnomon::exact
