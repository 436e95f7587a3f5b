// The cost estimates for collapses of one position onto several others, in vector lanes.
#pragma once

#include "preprocess/simplify/quadric.h"

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::simplify {

/// The position and attributes that an estimate needs: three rows of four numbers. The last number of each row is
/// unused.
struct alignas(32) CostSite {
    using Row = std::array<double, 4>;

    Row position{};
    Row normal{}; // zero if there is no normal
    Row color{};  // channels from 0 to 1

    bool hasNormal() const { return normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] > 0; }
};

/// Returns the first three numbers of a row as a vector.
inline glm::dvec3 vectorOf(const CostSite::Row& row) {
    return {row[0], row[1], row[2]};
}

/// The weights of the edge terms of the cost. All of them multiply the squared length.
struct EdgeWeights {
    double length = 0;
    double normal = 0; // times the squared difference of the normals, if both ends have one
    double color = 0;  // times the squared difference of the colours
};

/// The edges from one position to others. The planes of the position must have a positive weight.
struct EdgeFan {
    const CostSite& from;
    const Quadric& planes;
    std::span<const CostSite> sites;
    std::span<const std::uint32_t> to; // indices of `sites`
};

/// The max number of lanes. `edgeSquares` may write up to this number of additional values.
constexpr std::size_t kMaxCostLanes = 4;

/// Writes the estimates in the order of `fan.to`. They are identical to the bit with CostEstimate::square.
void edgeSquares(const EdgeFan& fan, const EdgeWeights& weights, double* squares);

} // namespace gnomon::simplify
