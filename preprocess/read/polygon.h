// Triangulates convex and concave polygons.
#pragma once

#include "core/progress.h"
#include "preprocess/read/mesh_source.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::read {

/// The three corners of a triangle in a polygon, as indices into the polygon's list of corners.
using PolygonTriangle = std::array<std::uint32_t, 3>;

/// Divides a polygon of n >= 3 corners into exactly n - 2 triangles with the same orientation, and appends them to
/// `out`. A strictly convex polygon becomes the fan from corner 0. Any other polygon is triangulated by ear clipping
/// (Meisters, "Polygons have ears", 1975). For this, the polygon is projected along the coordinate axis nearest to
/// Newell's normal. The projection causes no rounding. The triangles cover a simple polygon exactly. A polygon that
/// crosses itself also gives n - 2 triangles.
///
/// The time is about n log n for real outlines and bounded for any input. The limit is 2000 steps per corner. If
/// corners without area block the clipping, at most 1000 further steps per corner are made. If the polygon crosses
/// itself, at most 100 further steps per corner are made. The part of the polygon that remains at the limit becomes a
/// fan. The function polls `progress`. All computations are relative to the first corner, so corners can be at any
/// distance from the origin.
void triangulatePolygon(std::span<const glm::dvec3> corners, std::vector<PolygonTriangle>& out, Progress& progress);

/// Replaces triangle fans of polygons by triangulations that are also correct for concave polygons. The object reuses
/// its memory for all polygons.
class PolygonRefiner {
public:
    /// Creates a refiner that polls `progress`, so that the user can interrupt the triangulation of large polygons.
    explicit PolygonRefiner(Progress& progress) : progress_(progress) {}

    /// Retriangulates one polygon in place. `fan` is its triangle fan, the triangles of a PolygonRun. `positionOf`
    /// returns the position of a vertex index as a glm::dvec3.
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
