// Converts positions to whole steps of a model's vertex grid and back. Measurements between such positions are exact.
#pragma once

#include "hierarchy/grid.h"

#include <algorithm>
#include <cmath>

namespace gnomon::inspect {

/// Returns the point of the vertex grid nearest to a world-space point, in grid steps. The distance is at most half of
/// a cell's diagonal. The result can be outside the extent of the grid, up to 2^60 steps.
inline glm::i64vec3 cellOf(const hierarchy::Grid& grid, const glm::dvec3& point) {
    constexpr double kMaxCell = 0x1p60;
    const glm::dvec3 cells = glm::clamp((point - grid.origin) / grid.step(), -kMaxCell, kMaxCell);
    return {std::llround(cells.x), std::llround(cells.y), std::llround(cells.z)};
}

/// Returns the world-space position of the grid point `cell`, in the source's coordinates, rounded once to the nearest
/// double.
inline glm::dvec3 worldOf(const hierarchy::Grid& grid, const glm::i64vec3& cell) {
    return grid.origin + glm::dvec3(cell) * grid.step();
}

} // namespace gnomon::inspect
