// Measures a source mesh before it is sorted into chunks: counts, grid, and the number of triangle corners per vertex.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/vertex_lookup.h"
#include "preprocess/chunk/vertex_table.h"
#include "preprocess/read/mesh_source.h"
#include "preprocess/simplify/mesh.h"

#include <algorithm>
#include <vector>

namespace gnomon::chunk {

/// The treatment of triangles far outside the main part of a source (strays). Leave excludes them from the grid, and
/// Keep includes them.
enum class Strays : std::uint8_t { Leave, Keep };

/// The properties of a source mesh that are measured before it is sorted into chunks.
struct SourceSurvey {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest; // max grid coordinates of the vertices that triangles use
    // Bounds of the source without strays (triangles far outside). Without strays the bounds contain all vertices of
    // triangles.
    Box mainPart;
    double medianEdge = 0; // median length of the sampled edges; 0 without edges
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint64_t notAPolygon = 0;
    std::uint64_t badNormals = 0;      // normals that are not finite, unless the source's summary counts them
    bool hasPolygons = false;          // whether there are faces with more than three corners
    VertexTable<std::uint8_t> valence; // number of triangle corners per vertex, at most 255
    std::vector<hierarchy::Field> fields;
};

/// Measures `source` in one pass over the triangles and two passes over the vertices. If the source has fields, the
/// function makes a third pass over the vertices. It uses one byte per vertex and about 60 MiB. Errors of the source
/// are thrown to the caller.
SourceSurvey surveySource(read::MeshSource& source, Progress& progress, Strays strays = Strays::Leave);

/// A sample of the source triangles, whose edge lengths determine the grid step. A source of up to 512 Ki triangles is
/// sampled completely. For a larger source the sample contains at least 256 Ki triangles. The hash of the triangle
/// index selects them, so that the sample is deterministic.
class EdgeSample {
public:
    struct Entry {
        std::uint64_t hash = 0;
        read::TriangleCorners corners{};
    };

    EdgeSample() = default;

    /// Creates a sample for one part of a source that has `triangles` triangles in total. The samples of all parts
    /// together contain the sample of the source, and only few more triangles.
    explicit EdgeSample(std::uint64_t triangles);

    /// Adds the triangle with the index `index` if the hash of this index is below the threshold of the sample.
    void offer(std::uint64_t index, const read::TriangleCorners& corners);

    /// Adds a triangle from another sample if the hash of its index is below the threshold of this sample.
    void take(const Entry& entry);

    const std::vector<Entry>& entries() const { return entries_; }

    /// Returns the source indices of the vertices of all sampled triangles.
    std::vector<std::uint64_t> vertices() const;

    /// A histogram of edge lengths with 16 bins per power of two. The result does not depend on the order of the edges.
    class Lengths {
    public:
        void add(double length);

        /// Returns the quantile `fraction` of the edge lengths, rounded down to the start of its bin. The result is
        /// more than 16/17 of the exact quantile. Returns 0 without edges.
        double quantile(double fraction) const;

    private:
        std::vector<std::uint64_t> counts_;
        std::uint64_t total_ = 0;
    };

    /// Returns a histogram of the lengths of all sampled edges. `positions` must contain the positions of `vertices()`.
    Lengths measure(const VertexLookup& positions) const;

    /// Returns the part of `box` that contains the sampled triangles without strays (triangles far outside). Triangles
    /// are strays in two cases:
    /// - up to 0.1% of the triangles, if their distance from the bounds of the other triangles is larger than the width
    ///   of these bounds;
    /// - up to 16 triangles, and at most an eighth of all triangles, if their distance is larger than 1000 of these
    ///   widths.
    /// Only the triangles farthest from the median vertex can be strays. If there are no strays, the result is `box`.
    /// Otherwise the result is the bounds of all sampled vertices that are at most one width outside the other
    /// triangles, extended by 1/64 of the width.
    Box mainPart(const VertexLookup& positions, const Box& box) const;

private:
    std::vector<Entry> entries_;
    std::uint64_t threshold_ = ~std::uint64_t{0};
};

/// Extends `box` by the vertices of a block. Only vertices of triangles count, which have a `valence` above 0. Unused
/// vertices must not influence the grid step. Throws Error if a position is not finite.
void addUsed(
    read::MeshSource& source, const read::VertexBlock& block, const VertexTable<std::uint8_t>& valence, Box& box);

/// Computes the grid, the main part and the median edge length of `survey`. `box` contains all vertices of triangles.
/// `positions` contains the vertex positions of the edge sample. Throws Error if coordinates are too large.
void setGrid(
    SourceSurvey& survey,
    const std::string& path,
    const Box& box,
    const EdgeSample& sample,
    const VertexLookup& positions,
    Strays strays);

/// Returns the grid for positions within `box` and edges of these `lengths`. The grid step is at most
/// - 2^-20 of the extent of `mainPart`,
/// - 1/64 of the median edge length and 1/64 of the 10% quantile,
/// - half of the 2e-5 quantile of the edge lengths, if `box` fits into 2^30 steps.
/// The step is larger only if `mainPart` would need more than 2^30 steps. The step is never smaller than the spacing of
/// doubles at these coordinates. If `box` needs more than 2^30 steps, the grid's range is centred on `mainPart`, and a
/// part of `box` is outside the range.
hierarchy::Grid chooseGrid(const Box& box, const Box& mainPart, const EdgeSample::Lengths& lengths);

/// Snaps positions to the nearest grid points.
class GridSnap {
public:
    explicit GridSnap(const hierarchy::Grid& grid) : origin_(grid.origin), stepsPerUnit_(1 / grid.step()) {}

    hierarchy::GridPoint operator()(const glm::dvec3& position) const {
        const glm::dvec3 p = (position - origin_) * stepsPerUnit_;
        return {coordinate(p.x), coordinate(p.y), coordinate(p.z)};
    }

    /// Returns true if a grid point exists at most half a step from `position` on each axis.
    bool isInRange(const glm::dvec3& position) const {
        const glm::dvec3 p = (position - origin_) * stepsPerUnit_;
        return isInRange(p.x) && isInRange(p.y) && isInRange(p.z);
    }

private:
    static constexpr auto kMaxCoordinate = static_cast<double>(hierarchy::kMaxGridCoordinate);

    static std::uint32_t coordinate(double value) {
        return static_cast<std::uint32_t>(std::clamp(value + 0.5, 0.0, kMaxCoordinate));
    }

    static bool isInRange(double value) { return value >= -0.5 && value < kMaxCoordinate + 0.5; }

    glm::dvec3 origin_;
    double stepsPerUnit_;
};

} // namespace gnomon::chunk
