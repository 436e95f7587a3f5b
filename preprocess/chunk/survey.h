// The survey of a source mesh: counts, grid, and the number of triangles per vertex.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/vertex_lookup.h"
#include "preprocess/chunk/vertex_table.h"
#include "preprocess/read/mesh_source.h"
#include "preprocess/simplify/mesh.h"

#include <algorithm>
#include <vector>

namespace gnomon::chunk {

/// The treatment of triangles far outside the main part of a source: exclude them or include them.
enum class Strays : std::uint8_t { Leave, Keep };

/// The facts about a source that the binning needs.
struct SourceSurvey {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest; // max coordinates of snapped vertices of triangles
    Box mainPart;                  // contains all vertices of triangles if the source has no strays
    double medianEdge = 0;         // median length of the sampled edges; 0 without edges
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint64_t notAPolygon = 0;
    std::uint64_t badNormals = 0;      // normals that are not finite, if the source's summary does not count them
    bool hasPolygons = false;          // faces of more than three corners
    VertexTable<std::uint8_t> valence; // corners at each vertex, at most 255
    std::vector<hierarchy::Field> fields;
};

/// Surveys `source` in one pass over the triangles and two passes over the vertices, or three if there are fields. Uses
/// one byte per vertex and about 60 MiB. Throws Error if the source throws it.
SourceSurvey surveySource(read::MeshSource& source, Progress& progress, Strays strays = Strays::Leave);

/// A sample of triangles whose edges determine the grid step. It contains all triangles of a source of up to 512 Ki
/// triangles, and at least 256 Ki triangles of a larger source. The hash of the triangle index selects them, so that
/// the sample is deterministic.
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

    /// Adds the triangle `index` if its hash is small enough.
    void offer(std::uint64_t index, const read::TriangleCorners& corners);

    /// Adds an entry of another sample if its hash is small enough.
    void take(const Entry& entry);

    const std::vector<Entry>& entries() const { return entries_; }

    /// Returns the vertices of all sampled triangles.
    std::vector<std::uint64_t> vertices() const;

    /// A histogram of edge lengths with 16 bins per power of two. It does not depend on the order of the edges.
    class Lengths {
    public:
        void add(double length);

        /// Returns the lower end of the bin that contains the quantile: at most the quantile, and more than 16/17 of
        /// it. Returns 0 without edges.
        double quantile(double fraction) const;

    private:
        std::vector<std::uint64_t> counts_;
        std::uint64_t total_ = 0;
    };

    /// Returns the lengths of the sampled edges. `positions` must contain the positions of `vertices()`.
    Lengths measure(const VertexLookup& positions) const;

    /// Returns the part of `box` that contains the sampled triangles without strays. Triangles are strays in two cases:
    /// - up to 0.1% of the triangles, if their distance from the bounds of the rest is larger than the width of these
    /// bounds;
    /// - up to 16 triangles, at most an eighth, if they are 1000 times as far outside.
    /// Only the triangles farthest from the median vertex can be strays. Without strays the result is `box`. With
    /// strays, the result is the box of all sampled vertices at most one width outside the rest, extended by 1/64 of
    /// the width.
    Box mainPart(const VertexLookup& positions, const Box& box) const;

private:
    std::vector<Entry> entries_;
    std::uint64_t threshold_ = ~std::uint64_t{0};
};

/// Extends `box` by the used vertices of a block. Unused vertices do not count, because they would influence the grid
/// step. Throws Error for a position that is not finite.
void addUsed(
    read::MeshSource& source, const read::VertexBlock& block, const VertexTable<std::uint8_t>& valence, Box& box);

/// Sets the grid, the main part and the median edge of a survey. `box` contains the used vertices. `positions` contains
/// the positions of the sample's vertices. Throws Error for coordinates that are too large.
void setGrid(
    SourceSurvey& survey,
    const std::string& path,
    const Box& box,
    const EdgeSample& sample,
    const VertexLookup& positions,
    Strays strays);

/// Returns the grid for positions within `box` with edges of these `lengths`. The grid step is at most
/// - 2^-20 of the extent of `mainPart`,
/// - 1/64 of the median and of the 10% quantile of the edges.
/// If `box` fits into 2^30 steps, the step is also at most half of the 2e-5 quantile of the edges. The step is never
/// smaller than the spacing of doubles at these coordinates. The step is larger only if `mainPart` needs more than 2^30
/// steps. If `box` needs more, the grid's range is centred on `mainPart`, and the rest of `box` is outside the range.
hierarchy::Grid chooseGrid(const Box& box, const Box& mainPart, const EdgeSample::Lengths& lengths);

/// Snaps positions to the nearest grid points.
class GridSnap {
public:
    explicit GridSnap(const hierarchy::Grid& grid) : origin_(grid.origin), stepsPerUnit_(1 / grid.step()) {}

    hierarchy::GridPoint operator()(const glm::dvec3& position) const {
        const glm::dvec3 p = (position - origin_) * stepsPerUnit_;
        return {coordinate(p.x), coordinate(p.y), coordinate(p.z)};
    }

    /// Returns true if the grid has a point at most half a step away on each axis.
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
