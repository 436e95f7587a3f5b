// What of a triangle lies before a map's cells where a part of it lies beside or behind the point light.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <optional>

namespace gnomon::exact {

/// Cells along both axes, not yet whole.
struct CellReach {
    double leastX = 0;
    double leastY = 0;
    double mostX = 0;
    double mostY = 0;
};

/// The cells of [0, side] x [0, side] and `slack` around them that a triangle covers as its light sees it, or more;
/// nothing where it covers none. Corners are (x, y, 1) w, with w of any sign. Where what is left comes nearer to the
/// light than `leastW`, whose x / w nobody knows, all cells.
std::optional<CellReach> reachOfPyramid(
    const std::array<glm::dvec3, 3>& corners, double side, double slack, double leastW);

} // namespace gnomon::exact
