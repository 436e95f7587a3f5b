// Smoothing of a way: string pulling and rounded corners, as long as the body stays clear of obstacles.
#pragma once

#include "path/way_search.h"

namespace gnomon::path {

/// A point of a way over a floor.
struct WayPoint {
    glm::dvec2 at{0}; // x and z, in columns of the grid
    std::uint32_t cell = 0;
};

/// The result of a straight walk from `from` towards `to`: how far it goes over walkable floor, and its cost.
struct StraightRun {
    std::uint32_t end = FloorCell::kNone; // the cell of `to`, or kNone if the line is blocked
    double free = 0;                      // free length, in columns
    double cost = 0;                      // length weighted by wayWeight
};

/// Follows a straight line from cell to cell (Amanatides and Woo 1987).
StraightRun runStraight(const WalkableFloor& floor, const WayPoint& from, const glm::dvec2& to);

/// Returns the way through `cells`, in which each cell is a neighbour of the previous one. The function pulls the way
/// straight where this does not increase the cost. It inserts points at most a quarter of the eye height apart, and
/// rounds the corners. Each segment of the result is verified by runStraight.
std::vector<WayPoint> smoothWay(const WalkableFloor& floor, const std::vector<std::uint32_t>& cells);

} // namespace gnomon::path
