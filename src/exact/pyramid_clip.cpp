#include "exact/pyramid_clip.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace gnomon::exact {

namespace {

/// A clipped polygon with at most eight corners.
struct ClippedPolygon {
    static constexpr std::size_t kMaxCorners = 8; // three corners, and one more per clipping plane
    std::array<glm::dvec3, kMaxCorners> corners{};
    std::size_t count = 0;

    void add(const glm::dvec3& corner) { corners[count++] = corner; }
};

/// Clips `polygon` to the half-space dot(inward, p) >= 0 (Sutherland and Hodgman 1974).
ClippedPolygon clippedTo(const ClippedPolygon& polygon, const glm::dvec3& inward) {
    ClippedPolygon result;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec3& p = polygon.corners[i];
        const glm::dvec3& q = polygon.corners[(i + 1) % polygon.count];
        const double from = glm::dot(inward, p);
        const double to = glm::dot(inward, q);
        if (from >= 0) result.add(p);
        if ((from >= 0) != (to >= 0)) result.add(p + (from / (from - to)) * (q - p));
    }
    return result;
}

} // namespace

std::optional<CellReach> reachOfPyramid(
    const std::array<glm::dvec3, 3>& corners, double side, double slack, double minW) {
    ClippedPolygon polygon;
    for (const glm::dvec3& corner : corners)
        polygon.add(corner);
    for (const glm::dvec3& inward :
         {glm::dvec3(1, 0, slack),
          glm::dvec3(-1, 0, side + slack),
          glm::dvec3(0, 1, slack),
          glm::dvec3(0, -1, side + slack)})
        polygon = clippedTo(polygon, inward);
    if (polygon.count == 0) return std::nullopt;
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    CellReach reach{kInfinite, kInfinite, -kInfinite, -kInfinite};
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec3& p = polygon.corners[i];
        if (p.z < minW) return CellReach{0, 0, side, side};
        reach.minX = std::min(reach.minX, p.x / p.z);
        reach.minY = std::min(reach.minY, p.y / p.z);
        reach.maxX = std::max(reach.maxX, p.x / p.z);
        reach.maxY = std::max(reach.maxY, p.y / p.z);
    }
    return reach;
}

} // namespace gnomon::exact
