// What a first look at a source tells: its counts, its grid, and how many triangles use each vertex.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/vertex_lookup.h"
#include "preprocess/chunk/vertex_table.h"
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
    VertexTable<std::uint8_t> valence; // corners at each vertex, at most 255
    std::vector<hierarchy::Field> fields;
};

/// One pass over the triangles and two over the vertices, one more where these have fields, in one byte a vertex and
/// some 60 MiB. Throws Error where the source does.
SourceSurvey surveySource(read::MeshSource& source, Progress& progress);

/// The triangles whose edges the grid is chosen by: all of a source of up to 512 Ki triangles, else at least 256 Ki
/// drawn by a hash of their index, so the same ones for the same source.
class EdgeSample {
public:
    struct Entry {
        std::uint64_t hash = 0;
        read::TriangleCorners corners{};
    };

    EdgeSample() = default;

    /// Of a part of a source of `triangles` triangles: what all parts have together is enough, and not much more.
    explicit EdgeSample(std::uint64_t triangles);

    /// Takes or leaves the triangle `index`.
    void offer(std::uint64_t index, const read::TriangleCorners& corners);

    /// Takes or leaves what another sample had.
    void take(const Entry& entry);

    const std::vector<Entry>& entries() const { return entries_; }

    /// All corners.
    std::vector<std::uint64_t> vertices() const;

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

    /// The same with the positions of `vertices()`.
    Lengths measure(const VertexLookup& positions) const;

private:
    std::vector<Entry> entries_;
    std::uint64_t threshold_ = ~std::uint64_t{0};
};

/// Widens `box` by the vertices of a block that triangles use: a stray one would set the grid's step. Throws Error for
/// one that is not finite.
void addUsed(
    read::MeshSource& source, const read::VertexBlock& block, const VertexTable<std::uint8_t>& valence, Box& box);

/// Sets the grid of a survey by the `box` of the vertices that triangles use and the lengths of edges. Throws Error for
/// coordinates that cannot be computed with.
void setGrid(SourceSurvey& survey, const std::string& path, const Box& box, const EdgeSample::Lengths& lengths);

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
