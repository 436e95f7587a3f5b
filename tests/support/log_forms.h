// The closed forms of logarithmic maps on frustum faces for any light. docs/shadow_theory.md derives them.
#pragma once

#include "shadow/fit/view_frustum.h"

namespace gnomon::shadow {

/// Returns S of logarithmic maps on the faces that the light requires, including the evenly spaced map of the near
/// rectangle. S is the sum of K_i |N_i . L| over the side faces towards the light (away from it if the light is in
/// front), and aspect |v . L|. For square images, K = ln(f/n) / (2 sin theta). S is the integral of 1 / w_i^2 over the
/// lit area, so no maps need fewer texels.
double logStorageFactor(const ViewFrustum& frustum, const glm::dvec3& towardsLight);

/// Returns the same with M_t of each map instead of M_z, which includes the shear of its texels.
double logShearedStorageFactor(const ViewFrustum& frustum, const glm::dvec3& towardsLight);

} // namespace gnomon::shadow
