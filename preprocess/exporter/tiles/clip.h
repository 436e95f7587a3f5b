// Triangles cut off at the sides of a box of the grid, with the edges that lie on those sides.
#pragma once

#include "preprocess/exporter/cut_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::exporter {

/// A cell of an octree over the grid: [low, low + side] along each axis. What lies in a side that two cells share is
/// the upper one's.
struct TileCell {
    std::array<std::uint64_t, 3> low{};
    std::uint64_t side = 0;
};

/// Corners of a convex polygon that a triangle leaves inside a cell.
struct ClippedCorner {
    std::array<double, 3> place{}; // grid steps
    std::array<double, 3> normal{};
    std::array<double, 4> color{}; // red, green, blue, alpha as levels
};

/// What of a triangle lies in `cell`; fewer than three corners where nothing does. Sutherland and Hodgman, "Reentrant
/// polygon clipping", 1974. Edges that two triangles share are cut at the same place.
std::vector<ClippedCorner> clipped(std::span<const ClippedCorner> triangle, const TileCell& cell);

/// Whether both ends of an edge lie on one side of `cell`.
bool liesOnSide(const ClippedCorner& a, const ClippedCorner& b, const TileCell& cell);

} // namespace gnomon::exporter
