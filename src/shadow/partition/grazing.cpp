#include "shadow/partition/grazing.h"

#include "shadow/partition/region.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

namespace {

constexpr double kMinLogRows = 1e-4;

} // namespace

double minGrazing(const ViewFrustum& frustum, RowSpacing rows) {
    constexpr double kShare = 0.1; // g in units of n/f; the possible gain in S is a few times as large
    return rows == RowSpacing::Even ? kGrazing : std::clamp(kShare / frustum.depthRatio(), kMinLogRows, kGrazing);
}

double rowsMissed(const ViewFrustum& frustum, Face face, const glm::dvec3& towardsLight, double rows) {
    if (face == Face::Whole || face == Face::Near) return 0;
    const double sine = std::abs(glm::dot(outwardNormal(frustum, face), towardsLight));
    if (sine >= kGrazing) return 0;
    constexpr double kRoundings = 4 * 0x1p-24; // rounding error when floats are multiplied with the matrix
    return rows / std::log(frustum.depthRatio()) * kRoundings / std::max(sine, kMinLogRows);
}

} // namespace gnomon::shadow
