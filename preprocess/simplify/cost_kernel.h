// Computes the cost estimates for collapses of one position onto several other positions, one target per SIMD lane.
#pragma once

#include "preprocess/simplify/quadric.h"

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::simplify {

/// The coordinates and the attributes of a position, for the cost estimate. Each is a row of four numbers, of which the
/// last is unused.
struct alignas(32) CostSite {
    using Row = std::array<double, 4>;

    Row position{};
    Row normal{}; // zero if the vertex has no normal
    Row color{};  // channels from 0 to 1

    bool hasNormal() const { return normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] > 0; }
};

/// Returns the first three numbers of a row as a vector.
inline glm::dvec3 vectorOf(const CostSite::Row& row) {
    return {row[0], row[1], row[2]};
}

/// The weights of the three edge terms of a collapse cost. Each term is also multiplied by the squared edge length.
struct EdgeWeights {
    double length = 0;
    double normal = 0; // multiplies the squared difference of the normals, if both ends have a normal
    double color = 0;  // multiplies the squared difference of the colours
};

/// The edges from one position to the possible targets of its collapse. The quadric of the position must have a
/// positive weight.
struct EdgeFan {
    const CostSite& from;
    const Quadric& planes;
    std::span<const CostSite> sites;
    std::span<const std::uint32_t> to; // indices of `sites`
};

/// The max number of SIMD lanes. `edgeSquares` may write up to this number of additional values after its last result.
constexpr std::size_t kMaxCostLanes = 4;

/// Writes the squared cost estimates of the edges in `fan`, in the order of `fan.to`. The values are bit-identical to
/// CostEstimate::square.
void edgeSquares(const EdgeFan& fan, const EdgeWeights& weights, double* squares);

} // namespace gnomon::simplify
