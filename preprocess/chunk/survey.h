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

/// What to do with triangles far outside of the main part of a source.
enum class Strays : std::uint8_t { Leave, Keep };

struct SourceSurvey {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest; // no snapped vertex of a triangle lies beyond it on any axis
    Box mainPart;                  // contains all vertices of triangles unless the source has strays
    double medianEdge = 0;         // of the sampled edges; 0 without edges
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint64_t notAPolygon = 0;
    std::uint64_t badNormals = 0;      // normals that are not finite, if the source's summary does not count them
    bool hasPolygons = false;          // faces of more than three corners
    VertexTable<std::uint8_t> valence; // corners at each vertex, at most 255
    std::vector<hierarchy::Field> fields;
};

/// One pass over the triangles and two over the vertices, one more where these have fields, in one byte a vertex and
/// some 60 MiB. Throws Error where the source does.
SourceSurvey surveySource(read::MeshSource& source, Progress& progress, Strays strays = Strays::Leave);

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

    /// A histogram of edge lengths, with 16 bins from each power of two to the next. It does not depend on the order of
    /// the edges.
    class Lengths {
    public:
        void add(double length);

        /// Returns the lower end of the bin in which the quantile lies: at most the quantile, and more than 16/17 of
        /// it. Returns 0 without edges.
        double quantile(double fraction) const;

    private:
        std::vector<std::uint64_t> counts_;
        std::uint64_t total_ = 0;
    };

    /// Returns the lengths of the sampled edges. `positions` are those of `vertices()`.
    Lengths measure(const VertexLookup& positions) const;

    /// Returns the part of `box` in which the sampled triangles lie, without strays. Strays are
    /// - up to 0.1% of the triangles, if they lie further outside of the box of the others than this box is wide, or
    /// - up to 16 triangles, but at most an eighth, if they lie 1000 times as far outside.
    /// The triangles that may be strays are those that are furthest from the median vertex. Without strays the result
    /// is `box`, else the box of all sampled vertices that lie no further out than the others are wide, grown by 1/64.
    Box mainPart(const VertexLookup& positions, const Box& box) const;

private:
    std::vector<Entry> entries_;
    std::uint64_t threshold_ = ~std::uint64_t{0};
};

/// Widens `box` by the vertices of a block that triangles use: a stray one would set the grid's step. Throws Error for
/// one that is not finite.
void addUsed(
    read::MeshSource& source, const read::VertexBlock& block, const VertexTable<std::uint8_t>& valence, Box& box);

/// Sets the grid of a survey, its main part and its median edge. `box` contains the vertices that triangles use, and
/// `positions` are those of the sample's vertices. Throws Error for coordinates that cannot be computed with.
void setGrid(
    SourceSurvey& survey,
    const std::string& path,
    const Box& box,
    const EdgeSample& sample,
    const VertexLookup& positions,
    Strays strays);

/// Returns the grid for positions within `box` whose edges have these `lengths`. Its step is at most 2^-20 of the
/// extent of `mainPart`, 1/64 of the median and of the 10% quantile of the edges, and the spacing of doubles at most.
/// If `box` fits into 2^30 steps, it is also at most half of nearly the shortest edge. It is coarser only if `mainPart`
/// needs more than 2^30 steps. If `box` needs more, the grid's range is around `mainPart`, and the rest of `box` is
/// beyond it.
hierarchy::Grid chooseGrid(const Box& box, const Box& mainPart, const EdgeSample::Lengths& lengths);

/// Finds the points of a grid that are nearest to positions.
class GridSnap {
public:
    explicit GridSnap(const hierarchy::Grid& grid) : origin_(grid.origin), stepsPerUnit_(1 / grid.step()) {}

    hierarchy::GridPoint operator()(const glm::dvec3& position) const {
        const glm::dvec3 p = (position - origin_) * stepsPerUnit_;
        return {coordinate(p.x), coordinate(p.y), coordinate(p.z)};
    }

    /// Returns whether the grid has a point that is at most half a step away on each axis.
    bool isInRange(const glm::dvec3& position) const {
        const glm::dvec3 p = (position - origin_) * stepsPerUnit_;
        return isInRange(p.x) && isInRange(p.y) && isInRange(p.z);
    }

private:
    static constexpr auto kMost = static_cast<double>(hierarchy::kMaxGridCoordinate);

    static std::uint32_t coordinate(double value) {
        return static_cast<std::uint32_t>(std::clamp(value + 0.5, 0.0, kMost));
    }

    static bool isInRange(double value) { return value >= -0.5 && value < kMost + 0.5; }

    glm::dvec3 origin_;
    double stepsPerUnit_;
};

} // namespace gnomon::chunk
