// Clips a triangle to the view pyramid of a point light's map. Triangles that are partly beside or behind the light
// need this clipping.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <optional>

namespace gnomon::exact {

/// A range of grid cells along x and y. The ends can be fractions of cells.
struct CellReach {
    double minX = 0;
    double minY = 0;
    double maxX = 0;
    double maxY = 0;
};

/// Returns the range of cells that a triangle covers as seen from a point light, extended by `slack`. The range is
/// within [0, side] x [0, side] and may be too large. Returns nullopt if the triangle covers no cell. The corners are
/// (x, y, 1) w, with w of any sign. If the clipped triangle comes nearer to the light than `minW`, x / w is unreliable,
/// and the function returns all cells.
std::optional<CellReach> reachOfPyramid(
    const std::array<glm::dvec3, 3>& corners, double side, double slack, double minW);

} // namespace gnomon::exact
