// Clips triangles at the sides of a grid box and finds the edges on these sides.
#pragma once

#include "preprocess/exporter/cut_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::exporter {

/// A cell of an octree over the grid: [low, low + side] along each axis. Geometry in a side between two cells belongs
/// to the upper cell.
struct TileCell {
    std::array<std::uint64_t, 3> low{};
    std::uint64_t side = 0;
};

/// A corner of the convex polygon that remains of a triangle inside a cell.
struct ClippedCorner {
    std::array<double, 3> place{}; // grid steps
    std::array<double, 3> normal{};
    std::array<double, 4> color{}; // red, green, blue, alpha as levels
};

/// Returns the part of a triangle inside `cell`, with fewer than three corners if there is none (Sutherland, Hodgman,
/// "Reentrant Polygon Clipping", 1974). An edge of two triangles is cut at the same point in both.
std::vector<ClippedCorner> clipped(std::span<const ClippedCorner> triangle, const TileCell& cell);

/// Returns true if both ends of an edge are on the same side of `cell`.
bool liesOnSide(const ClippedCorner& a, const ClippedCorner& b, const TileCell& cell);

} // namespace gnomon::exporter
