// Handles frustum faces that the light grazes: the min angle between light and face for which the face has its own
// shadow map, and the rounding error of lookups in such a map.
#pragma once

#include "shadow/partition/faces.h"

namespace gnomon::shadow {

/// Returns the min sine g of the angle between light and frustum face for which the face has its own shadow map. With
/// even rows, the result is 1e-3. With logarithmic rows and a warp about the eye, a neighbouring map covers the omitted
/// face, and the storage factor S of this map grows in proportion to g f/n. The result is then 0.1 n/f, but at least
/// 1e-4, because below 1e-4 floats cannot distinguish the rows of such a map.
double minGrazing(const ViewFrustum& frustum, RowSpacing rows);

/// Returns the rounding error of a lookup in single precision, in rows, for the map of `face` with `rows` logarithmic
/// rows. If the sine of the angle between light and face is below 1e-3, the row depends on small differences, and the
/// error matters. Otherwise the result is 0, because the margin for subpixels covers the error.
double rowsMissed(const ViewFrustum& frustum, Face face, const glm::dvec3& towardsLight, double rows);

} // namespace gnomon::shadow
