// What a first look at a source tells: its counts, its grid, and how many triangles use each vertex.
#pragma once

#include "core/progress.h"
#include "preprocess/read/mesh_source.h"
#include "preprocess/simplify/mesh.h"

#include <algorithm>
#include <vector>

namespace gnomon::chunk {

struct SourceSurvey {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest; // no snapped vertex of a triangle lies beyond it on any axis
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint64_t notAPolygon = 0;
    bool hasPolygons = false;          // faces of more than three corners
    std::vector<std::uint8_t> valence; // corners at each vertex, at most 255
    std::vector<hierarchy::Field> fields;
};

/// One pass over the triangles and two over the vertices, one more where these have fields, in one byte a vertex and
/// some 60 MiB. Throws Error where the source does, for more vertices or triangles than 32 bits count, and for a source
/// without triangles.
SourceSurvey surveySource(read::MeshSource& source, Progress& progress);

/// The triangles whose edges the grid is chosen by: all of a source of up to 512 Ki triangles, else at least 256 Ki
/// drawn by a hash of their index, so the same ones for the same source.
class EdgeSample {
public:
    /// Takes or leaves the triangle `index`.
    void offer(std::uint64_t index, const read::TriangleCorners& corners);

    /// Edge lengths by powers of two: enough for a median and a low quantile, and free of order.
    class Lengths {
    public:
        void add(double length);

        /// A power of two that is at most the length of all but the shortest `fraction` of the edges, or 0 without
        /// edges.
        double quantile(double fraction) const;

    private:
        std::vector<std::uint64_t> counts_;
        std::uint64_t total_ = 0;
    };

    /// The lengths of the sampled edges: one pass over the vertices.
    Lengths measure(read::MeshSource& source) const;

private:
    struct Entry {
        std::uint64_t hash = 0;
        std::array<std::uint32_t, 3> corners{};
    };

    std::vector<Entry> entries_;
    std::uint64_t threshold_ = ~std::uint64_t{0};
};

/// The grid for positions within `box` whose edges have these `lengths`: a step of at most 2^-20 of the extent, 1/64 of
/// the median edge and half of nearly the shortest; coarser only where 30 bits or the spacing of doubles end.
hierarchy::Grid chooseGrid(const Box& box, const EdgeSample::Lengths& lengths);

/// Finds the points of a grid that are nearest to positions.
class GridSnap {
public:
    explicit GridSnap(const hierarchy::Grid& grid) : origin_(grid.origin), stepsPerUnit_(1 / grid.step()) {}

    hierarchy::GridPoint operator()(const glm::dvec3& position) const {
        const glm::dvec3 p = (position - origin_) * stepsPerUnit_;
        return {coordinate(p.x), coordinate(p.y), coordinate(p.z)};
    }

private:
    static std::uint32_t coordinate(double value) {
        constexpr auto kMost = static_cast<double>(hierarchy::kMaxGridCoordinate);
        return static_cast<std::uint32_t>(std::clamp(value + 0.5, 0.0, kMost));
    }

    glm::dvec3 origin_;
    double stepsPerUnit_;
};

} // namespace gnomon::chunk
