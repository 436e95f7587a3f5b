// Clips triangles of a model by section planes. The corners of the results are rounded to the grid.
#pragma once

#include "core/convex_volume.h"
#include "hierarchy/grid.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace gnomon::render {

inline constexpr std::size_t kMaxSections = 6;

glm::dvec3 gridCellOf(const hierarchy::GridPoint& point);

/// A convex polygon with corners on the grid: a triangle clipped by at most kMaxSections planes.
struct GridPolygon {
    std::array<glm::dvec3, 3 + kMaxSections> corners{};
    std::size_t size = 0;

    void add(const glm::dvec3& corner) { corners.at(size++) = corner; }
};

/// Clips `polygon` by `plane` and returns the part whose distance to the plane is at least 0. New corners are rounded
/// to the grid. Two triangles with a common edge compute the same new corner on it.
GridPolygon clipped(const GridPolygon& polygon, const Plane& plane);

} // namespace gnomon::render
