// Faces at grazing angles to the light: the min angle of a face with its own map, and the rounding error of lookups in
// such a map.
#pragma once

#include "shadow/partition/faces.h"

namespace gnomon::shadow {

/// Returns the smallest sine of the angle between light and face for which the face gets its own map. It is 1e-3 with
/// even rows. With logarithmic rows and a warp about the eye, a neighbour covers the omitted face. Its S grows in
/// proportion to g f/n, where g is the sine. The result is then 0.1 n/f, but at least 1e-4: below 1e-4, floats cannot
/// distinguish the rows of such a map.
double minGrazing(const ViewFrustum& frustum, RowSpacing rows);

/// Returns the rounding error of a float lookup, in rows, for the map of `face` with logarithmic rows and `rows` rows.
/// The error matters only if the sine of the angle between light and face is below 1e-3, because the row then depends
/// on small differences. Otherwise the result is 0, and the margin for subpixels covers the error.
double rowsMissed(const ViewFrustum& frustum, Face face, const glm::dvec3& towardsLight, double rows);

} // namespace gnomon::shadow
