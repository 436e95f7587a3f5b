// An independent version of the predicate. It intersects the ray and the triangle by Cramer's rule in 256 bits, and
// moves the point by (e, e^2, e^3) with polynomials of e.
#pragma once

#include "exact/predicate.h"

namespace gnomon::exact {

/// Returns the same result as `intersectTowards`, for the line through the point and the light.
RayHit plainPointHit(const Corners& caster, const glm::i64vec3& light, const glm::i64vec3& scaledPoint);

/// Returns the same result as `intersect`.
RayHit plainHit(
    const Corners& caster, const IntegerLight& light, const glm::i64vec3& scaledPoint, std::uint32_t tolerance);

} // namespace gnomon::exact
