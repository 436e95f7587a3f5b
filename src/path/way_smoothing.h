// Smooths the route of a walk: straightens it (string pulling) and rounds its corners, while the person stays clear of
// obstacles.
#pragma once

#include "path/way_search.h"

namespace gnomon::path {

/// A point of a route over a floor.
struct WayPoint {
    glm::dvec2 at{0}; // x and z, in columns of the grid
    std::uint32_t cell = 0;
};

/// The result of a straight walk from `from` towards `to`: how far the floor is walkable, and the cost of this way.
struct StraightRun {
    std::uint32_t end = FloorCell::kNone; // the cell of `to`, or kNone if the line is blocked
    double free = 0;                      // free length, in columns
    double cost = 0;                      // length weighted by wayWeight
};

/// Walks along a straight line from floor cell to floor cell (Amanatides and Woo 1987), and returns how far it gets.
StraightRun runStraight(const WalkableFloor& floor, const WayPoint& from, const glm::dvec2& to);

/// Returns a smooth route through `cells`, each of which is a neighbour of the previous one. The function straightens
/// the route where this does not increase the cost. It inserts points at most a quarter of the eye height apart, and
/// rounds the corners. runStraight verifies each segment of the result.
std::vector<WayPoint> smoothWay(const WalkableFloor& floor, const std::vector<std::uint32_t>& cells);

} // namespace gnomon::path
