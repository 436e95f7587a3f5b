// Clipping of a model's triangles by planes, with corners on the grid.
#pragma once

#include "core/convex_volume.h"
#include "hierarchy/grid.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace gnomon::render {

inline constexpr std::size_t kMaxSections = 6;

glm::dvec3 gridCellOf(const hierarchy::GridPoint& point);

/// A convex polygon of grid points: a triangle clipped by at most kMaxSections planes.
struct GridPolygon {
    std::array<glm::dvec3, 3 + kMaxSections> corners{};
    std::size_t size = 0;

    void add(const glm::dvec3& corner) { corners.at(size++) = corner; }
};

/// Returns the part of `polygon` with a distance of at least 0 to `plane`, in cells. New corners are rounded to the
/// grid, equally for both triangles at an edge.
GridPolygon clipped(const GridPolygon& polygon, const Plane& plane);

} // namespace gnomon::render
