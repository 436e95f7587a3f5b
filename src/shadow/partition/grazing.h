// Faces that the light grazes: from which angle on they have maps, and what lookups in these take for roundings.
#pragma once

#include "shadow/partition/faces.h"

namespace gnomon::shadow {

/// The sine of the light's angle to a face from which on it has a map: 1e-3 with even rows. About the eye with
/// logarithmic rows a neighbour that takes over a face of sine g covers g f beside the line of the near edge, and its S
/// grows in proportion to g f/n: so it is 0.1 n/f there, but at least 1e-4, below which floats do not tell the rows of
/// such a map apart.
double leastGrazing(const ViewFrustum& frustum, RowSpacing rows);

/// By how many of `rows` floats may miss one in the map with logarithmic rows of `face` where the light is within 1e-3
/// of its plane: what tells rows apart there are small differences. Else 0, as subpixels cover it.
double rowsMissed(const ViewFrustum& frustum, Face face, const glm::dvec3& towardsLight, double rows);

} // namespace gnomon::shadow
