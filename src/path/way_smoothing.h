// A found way made smooth: strings pulled and corners rounded as long as the body keeps clear.
#pragma once

#include "path/way_search.h"

namespace gnomon::path {

/// A point of a way over a floor.
struct WayPoint {
    glm::dvec2 at{0}; // x and z in columns of the grid
    std::uint32_t cell = 0;
};

/// How far the straight line from `from` towards `to` runs over floor that the body may walk on, and at what cost.
struct StraightRun {
    std::uint32_t end = FloorCell::kNone; // the cell of `to`; kNone if the line does not get there
    double free = 0;                      // how much of it was free, columns
    double cost = 0;                      // its length by wayWeight
};

/// Follows a straight line from cell to cell (Amanatides and Woo 1987).
StraightRun runStraight(const WalkableFloor& floor, const WayPoint& from, const glm::dvec2& to);

/// The way through `cells` (each a neighbour of the one before), pulled straight where that costs no more, with points
/// a quarter of an eye's height apart or nearer, then rounded; each straight line between two points was run.
std::vector<WayPoint> smoothWay(const WalkableFloor& floor, const std::vector<std::uint32_t>& cells);

} // namespace gnomon::path
