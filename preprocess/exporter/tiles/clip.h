// Clips triangles to a box of the grid, and finds edges that lie on the faces of this box.
#pragma once

#include "preprocess/exporter/cut_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::exporter {

/// An octree cell of the grid: [low, low + side] along each axis. Triangles in the common face of two cells belong to
/// the upper cell.
struct TileCell {
    std::array<std::uint64_t, 3> low{};
    std::uint64_t side = 0;
};

/// A corner of the convex polygon that remains after a triangle is clipped to a cell.
struct ClippedCorner {
    std::array<double, 3> place{}; // in grid steps
    std::array<double, 3> normal{};
    std::array<double, 4> color{}; // red, green, blue and alpha, from 0 to 255
};

/// Returns the part of a triangle inside `cell`, as a convex polygon (Sutherland, Hodgman, "Reentrant Polygon
/// Clipping", 1974). The result has fewer than three corners if this part is empty. Two triangles with a common edge
/// are cut at the same point of this edge.
std::vector<ClippedCorner> clipped(std::span<const ClippedCorner> triangle, const TileCell& cell);

/// Returns true if the edge from `a` to `b` lies on one of the six faces of `cell`.
bool liesOnSide(const ClippedCorner& a, const ClippedCorner& b, const TileCell& cell);

} // namespace gnomon::exporter
