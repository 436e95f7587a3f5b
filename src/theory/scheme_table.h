// `gnomon theory table`: what every scheme costs for one view and light, k = 1 to 8.
#pragma once

#include "shadow/fit/view_frustum.h"

#include <string>
#include <vector>

namespace gnomon::theory {

/// One row: a scheme at k slices.
struct SchemeRow {
    std::string scheme{}; // ZP, ZP+W, FP+ZP, FP+ZP+W, FP, ZP stable
    std::string warp{};   // as the option --warp says it; auto* is auto in the chosen orientation
    int slices = 1;
    std::size_t maps = 1;
    double storageFactor = 0;
    double shearedStorageFactor = 0; // with the shear of texels counted
    double worstX = 0;               // M_x and M_z with res_i = res_s = res_t = 1, the largest of all maps
    double worstZ = 0;
};

/// The rows of every scheme, k = 1 to 8; `towardsLight` is a unit vector in camera space.
std::vector<SchemeRow> schemeTable(const shadow::ViewFrustum& frustum, const glm::dvec3& towardsLight);

} // namespace gnomon::theory
