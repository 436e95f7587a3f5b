// A triangle of a model and what planes leave of it, with corners on the grid.
#pragma once

#include "core/convex_volume.h"
#include "hierarchy/grid.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace gnomon::executor {

inline constexpr std::size_t kMostSections = 6;

glm::dvec3 gridCellOf(const hierarchy::GridPoint& point);

/// A convex polygon of points of the grid: a triangle that at most kMostSections planes cut.
struct GridPolygon {
    std::array<glm::dvec3, 3 + kMostSections> corners{};
    std::size_t size = 0;

    void add(const glm::dvec3& corner) { corners.at(size++) = corner; }
};

/// What of it has a distance of at least 0 to a plane, in cells. Corners that this makes are rounded to the grid, alike
/// for both triangles at an edge.
GridPolygon clipped(const GridPolygon& polygon, const Plane& plane);

} // namespace gnomon::executor
