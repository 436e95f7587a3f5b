// Computes the cost of each shadow map scheme for one view and one light, for k = 1 to 8 slices. `gnomon theory table`
// prints it.
#pragma once

#include "shadow/fit/view_frustum.h"

#include <string>
#include <vector>

namespace gnomon::theory {

/// A row of the cost table: a shadow map scheme with k slices.
struct SchemeRow {
    std::string scheme{}; // ZP, ZP+W, FP+ZP, FP+ZP+W, FP, ZP stable
    std::string warp{};   // value of the option --warp; auto* is auto with the orientation of the smallest S
    int slices = 1;
    std::size_t maps = 1;
    double storageFactor = 0;
    double shearedStorageFactor = 0; // storage factor that includes the shear of texels
    double worstX = 0;               // M_x and M_z with res_i = res_s = res_t = 1, max over all maps
    double worstZ = 0;
};

/// Returns the cost of all shadow map schemes for k = 1 to 8 slices. `towardsLight` is a unit vector in camera space.
std::vector<SchemeRow> schemeTable(const shadow::ViewFrustum& frustum, const glm::dvec3& towardsLight);

} // namespace gnomon::theory
