// Cutting a polygon into triangles, concave ones rightly.
#pragma once

#include "core/progress.h"
#include "preprocess/read/mesh_source.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::read {

/// The three corners of a triangle as positions in the polygon's list of corners.
using PolygonTriangle = std::array<std::uint32_t, 3>;

/// Cuts a polygon of n >= 3 corners into exactly n - 2 triangles that keep its orientation. A strictly convex one
/// becomes the fan from corner 0; any other is cut by ear clipping in its plane (Newell's normal, projected along the
/// nearest axis, which rounds nothing), which covers a simple polygon exactly; one that crosses itself still gives
/// n - 2 triangles. Time is about n log n for real outlines and bounded for any input: two thousand steps per corner,
/// and one hundred from where the polygon turns out to cross itself (a thousand where corners without area are in the
/// way); what is left then becomes a fan. Polls `progress`. Appends to `out`. Corners may be at any distance from the
/// origin: all is relative to the first. Source: Meisters, "Polygons have ears", 1975.
void triangulatePolygon(std::span<const glm::dvec3> corners, std::vector<PolygonTriangle>& out, Progress& progress);

/// Replaces the fans of a TriangleBlock by right triangulations; keeps its scratch between polygons.
class PolygonRefiner {
public:
    /// Polls `progress`, so that many polygons can be interrupted.
    explicit PolygonRefiner(Progress& progress) : progress_(progress) {}

    /// Rewrites `fan` (the triangles of one PolygonRun) in place; `positionOf(vertex index)` gives a glm::dvec3.
    template <class PositionOf>
    void refine(std::span<TriangleCorners> fan, PositionOf positionOf) {
        vertices_.assign({fan.front()[0], fan.front()[1]});
        for (const TriangleCorners& triangle : fan)
            vertices_.push_back(triangle[2]);
        positions_.clear();
        for (const std::uint64_t vertex : vertices_)
            positions_.push_back(positionOf(vertex));
        triangles_.clear();
        triangulatePolygon(positions_, triangles_, progress_);
        for (std::size_t i = 0; i < fan.size(); ++i)
            fan[i] = {vertices_[triangles_[i][0]], vertices_[triangles_[i][1]], vertices_[triangles_[i][2]]};
    }

private:
    Progress& progress_;
    std::vector<std::uint64_t> vertices_;
    std::vector<glm::dvec3> positions_;
    std::vector<PolygonTriangle> triangles_;
};

} // namespace gnomon::read
