// The survey of a source mesh before the binning: counts, grid, and the number of triangle corners per vertex.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/vertex_lookup.h"
#include "preprocess/chunk/vertex_table.h"
#include "preprocess/read/mesh_source.h"
#include "preprocess/simplify/mesh.h"

#include <algorithm>
#include <vector>

namespace gnomon::chunk {

/// The treatment of strays, which are triangles far outside the main part of a source. Leave excludes them, and Keep
/// includes them.
enum class Strays : std::uint8_t { Leave, Keep };

/// The properties of a source that the binning needs.
struct SourceSurvey {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest; // max coordinates of the snapped vertices that triangles use
    // bounds without strays; without strays in the source it contains all vertices of triangles
    Box mainPart;
    double medianEdge = 0; // median length of the sampled edges; 0 without edges
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint64_t notAPolygon = 0;
    std::uint64_t badNormals = 0;      // normals that are not finite, if the source's summary does not count them
    bool hasPolygons = false;          // whether there are faces with more than three corners
    VertexTable<std::uint8_t> valence; // per vertex: number of triangle corners, at most 255
    std::vector<hierarchy::Field> fields;
};

/// Surveys `source` in one pass over the triangles and two passes over the vertices. If the source has fields, the
/// function makes a third pass over the vertices. It uses one byte per vertex and about 60 MiB. Errors of the source
/// are thrown to the caller.
SourceSurvey surveySource(read::MeshSource& source, Progress& progress, Strays strays = Strays::Leave);

/// A sample of triangles whose edge lengths determine the grid step. For a source of up to 512 Ki triangles the sample
/// contains all triangles. For a larger source it contains at least 256 Ki triangles. The hash of the triangle index
/// selects them, so that the sample is deterministic.
class EdgeSample {
public:
    struct Entry {
        std::uint64_t hash = 0;
        read::TriangleCorners corners{};
    };

    EdgeSample() = default;

    /// Creates a sample for one part of a source. `triangles` is the number of triangles of the whole source. The
    /// samples of all parts together contain the sample of the source, and only few more triangles.
    explicit EdgeSample(std::uint64_t triangles);

    /// Adds the triangle `index` if its hash is below the threshold of the sample.
    void offer(std::uint64_t index, const read::TriangleCorners& corners);

    /// Adds an entry of another sample if its hash is below the threshold.
    void take(const Entry& entry);

    const std::vector<Entry>& entries() const { return entries_; }

    /// Returns the vertices of all sampled triangles.
    std::vector<std::uint64_t> vertices() const;

    /// A histogram of edge lengths with 16 bins per power of two. The result does not depend on the order of the edges.
    class Lengths {
    public:
        void add(double length);

        /// Returns the lower end of the bin that contains the quantile `fraction`. The result is at most the quantile
        /// and more than 16/17 of it. Returns 0 without edges.
        double quantile(double fraction) const;

    private:
        std::vector<std::uint64_t> counts_;
        std::uint64_t total_ = 0;
    };

    /// Returns the lengths of the sampled edges. `positions` must contain the positions of `vertices()`.
    Lengths measure(const VertexLookup& positions) const;

    /// Returns the part of `box` that contains the sampled triangles without strays. Triangles are strays in two cases:
    /// - up to 0.1% of the triangles, if their distance from the bounds of the other triangles is larger than the width
    ///   of these bounds;
    /// - up to 16 triangles, and at most an eighth of all triangles, if their distance is larger than 1000 of these
    ///   widths.
    /// Only the triangles farthest from the median vertex can be strays. If there are no strays, the result is `box`.
    /// If there are strays, the result is the bounds of all sampled vertices that are at most one width outside the
    /// other triangles, extended by 1/64 of the width.
    Box mainPart(const VertexLookup& positions, const Box& box) const;

private:
    std::vector<Entry> entries_;
    std::uint64_t threshold_ = ~std::uint64_t{0};
};

/// Extends `box` by the vertices of a block that triangles use (`valence` above 0). Unused vertices must not influence
/// the grid step. Throws Error if a position is not finite.
void addUsed(
    read::MeshSource& source, const read::VertexBlock& block, const VertexTable<std::uint8_t>& valence, Box& box);

/// Computes the grid, the main part and the median edge of a survey. `box` contains the vertices that triangles use.
/// `positions` contains the positions of the sample's vertices. Throws Error if coordinates are too large.
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
