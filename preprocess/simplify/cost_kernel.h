// The estimates for moving one position onto several others, in vector lanes.
#pragma once

#include "preprocess/simplify/quadric.h"

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::simplify {

/// What the estimates need to know of a position besides its planes: three rows of four numbers, the last of each for
/// nothing.
struct alignas(32) CostSite {
    using Row = std::array<double, 4>;

    Row position{};
    Row normal{}; // zero for none
    Row color{};  // channels in 0..1

    bool hasNormal() const { return normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] > 0; }
};

inline glm::dvec3 vectorOf(const CostSite::Row& row) {
    return {row[0], row[1], row[2]};
}

/// Weights of what an edge costs besides the planes, all of the squared length.
struct EdgeWeights {
    double length = 0;
    double normal = 0; // times the squared difference of the normals, where both ends have one
    double color = 0;  // times the squared difference of the colours
};

/// The edges from one position, whose planes have some weight, to others.
struct EdgeFan {
    const CostSite& from;
    const Quadric& planes;
    std::span<const CostSite> sites;
    std::span<const std::uint32_t> to; // places in `sites`
};

/// How many numbers `edgeSquares` may write behind those that are asked for.
constexpr std::size_t kMostCostLanes = 4;

/// Writes the estimates, by `fan.to`, as CostEstimate::square has them to the bit.
void edgeSquares(const EdgeFan& fan, const EdgeWeights& weights, double* squares);

} // namespace gnomon::simplify
