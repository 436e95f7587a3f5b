// The predicate once more, by another road: the ray is cut with the triangle by Cramer's rule in 256 bits, and the
// point is really moved by (e, e^2, e^3), as polynomials of e.
#pragma once

#include "exact/predicate.h"

namespace gnomon::exact {

/// Answers as `meetTowards` does: the line through point and light is cut with the triangle likewise.
RayMeeting plainPointMeeting(const Corners& caster, const glm::i64vec3& light, const glm::i64vec3& scaledPoint);

/// Answers as `meet` does.
RayMeeting plainMeeting(
    const Corners& caster, const IntegerLight& light, const glm::i64vec3& scaledPoint, std::uint32_t tolerance);

} // namespace gnomon::exact
