#include "render/view/grid_polygon.h"

namespace gnomon::render {

namespace {

/// Returns the intersection of the edge from `a` to `b` with a plane, rounded to the grid. `atA` and `atB` are the
/// signed distances of the ends from the plane. The result is the same for both directions of the edge.
glm::dvec3 crossing(const glm::dvec3& a, double atA, const glm::dvec3& b, double atB) {
    const bool isTurned = a.x != b.x ? b.x < a.x : a.y != b.y ? b.y < a.y : b.z < a.z;
    const glm::dvec3 hit = isTurned ? b + (a - b) * (atB / (atB - atA)) : a + (b - a) * (atA / (atA - atB));
    const glm::u64vec3 nearest(hit + 0.5); // truncation rounds correctly, because coordinates are not negative
    return {nearest.x, nearest.y, nearest.z};
}

} // namespace

glm::dvec3 gridCellOf(const hierarchy::GridPoint& point) {
    return {point.x, point.y, point.z};
}

GridPolygon clipped(const GridPolygon& polygon, const Plane& plane) {
    std::array<double, 3 + kMaxSections> sides{};
    for (std::size_t i = 0; i < polygon.size; ++i)
        sides[i] = plane.signedDistance(polygon.corners[i]);
    GridPolygon rest;
    for (std::size_t i = 0; i < polygon.size; ++i) {
        const std::size_t next = i + 1 < polygon.size ? i + 1 : 0;
        if (sides[i] >= 0) rest.add(polygon.corners[i]);
        if ((sides[i] >= 0) != (sides[next] >= 0))
            rest.add(crossing(polygon.corners[i], sides[i], polygon.corners[next], sides[next]));
    }
    return rest;
}

} // namespace gnomon::render
