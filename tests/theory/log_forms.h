// The closed forms of logarithmic maps on the faces of the frustum, for any light: docs/shadow_theory.md derives them.
#pragma once

#include "shadow/fit/view_frustum.h"

namespace gnomon::shadow {

/// S of logarithmic maps on the faces that the light calls for, the near square's even one included: K_i |N_i . L| over
/// the side faces turned to the light (turned from it where it is in front), and aspect |v . L|. With square images
/// K = ln(f/n) / (2 sin theta). It is the integral of 1 / w_i^2 over what the light sees, so no maps need fewer texels.
double logStorageFactor(const ViewFrustum& frustum, const glm::dvec3& towardsLight);

/// The same with M_t of each map in place of M_z, the shear of its texels counted.
double logShearedStorageFactor(const ViewFrustum& frustum, const glm::dvec3& towardsLight);

} // namespace gnomon::shadow
