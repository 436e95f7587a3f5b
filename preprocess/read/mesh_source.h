// The interface of all inputs of a build: a MeshSource streams the vertices and triangles of a mesh in repeatable
// passes, in bounded memory.
#pragma once

#include "core/camera.h"
#include "core/error.h"
#include "core/progress.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::read {

/// The name under which all readers count non-finite normals in MeshSummary::attributesDropped.
constexpr const char* kBadNormals = "normals that are not finite";

/// The properties of an input before its body is read. The counts come from the header. They are checked against the
/// size of the file, so an estimate of memory may use them. Only a complete pass proves them.
struct MeshSummary {
    std::string path;            ///< path of the input; the paths of several inputs are joined by ", "
    std::uint64_t fileBytes = 0; ///< total size of all inputs
    std::uint64_t vertexCount = 0;
    std::uint64_t faceCount = 0;       ///< number of polygons with any number of corners
    std::uint64_t stripCount = 0;      ///< number of rows with triangle strips; a row can have several strips
    std::uint64_t likelyTriangles = 0; ///< estimated number of triangles of all faces and strips
    bool hasNormals = false;
    bool hasColors = false;
    bool isDouble = false;           ///< positions need double precision
    bool hasRanges = false;          ///< the rows can be read in any order, see MeshSource::indexRows
    std::vector<std::string> fields; ///< names of the scalar vertex properties that are read
    std::uint64_t heldBytes = 0;     ///< memory that the source uses during its lifetime
    /// Other files that were read because an input refers to them: buffers, images, material libraries.
    std::vector<std::string> additionalFiles;
    std::map<std::string, std::uint64_t> attributesDropped; ///< data of the input that is not read: name and count
    std::vector<Camera> cameras; ///< cameras of the input's scene; all have the same projection
    /// Notes on ambiguous inputs and how they were read; one line each, beginning with the path.
    std::vector<std::string> remarks;
    /// Mean number of texels per triangle edge, if textures were sampled at the vertices. Detail between them is lost.
    std::optional<double> texelsPerEdge;
};

/// A block of consecutive vertices. It is valid only during the call of the sink.
struct VertexBlock {
    std::uint64_t firstVertex = 0;
    /// Finite for each vertex that a triangle uses; otherwise the builder rejects the source.
    std::span<const glm::dvec3> positions;
    std::span<const glm::vec3> normals;    ///< as stored; zero if not finite; empty if the input has no normals
    std::span<const std::uint32_t> colors; ///< RGBA8, red in the lowest byte; empty if the input has no colours
    /// One value per vertex and name in MeshSummary::fields, vertex by vertex, as stored.
    std::span<const double> fields;
    std::uint64_t badNormals = 0; ///< number of non-finite normals in this block, if the summary does not count them
};

/// The vertex indices of one triangle, each below the summary's vertexCount.
using TriangleCorners = std::array<std::uint64_t, 3>;

/// A polygon with more than three corners in a TriangleBlock. Triangles [first, first + count) of the block are the fan
/// from its corner 0. The polygon has count + 2 corners: the first two corners of triangle `first`, then the last
/// corner of each triangle.
struct PolygonRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// A block of consecutive triangles in file order. It is valid only during the call of the sink.
///
/// A polygon of n corners is n - 2 consecutive triangles in one block. The reader has no positions, so it delivers the
/// fan from the first corner and lists it in `polygons`. The fan is correct for convex polygons. The code that has the
/// positions calls PolygonRefiner::refine (polygon.h) on each run. An out-of-core builder can do this after it has
/// joined the positions to the triangles, because the fan contains every corner and the source indices of a run are
/// consecutive.
struct TriangleBlock {
    std::uint64_t firstTriangle = 0; ///< source index of triangles[0]
    std::span<const TriangleCorners> triangles;
    std::span<const PolygonRun> polygons; ///< in ascending order of `first`
    /// Number of faces in this block that have fewer than three corners, so no triangles.
    std::uint64_t notAPolygon = 0;

    /// Calls `use` for each face with its triangles: one triangle, or the fan of a polygon.
    template <class Use>
    void forEachFace(Use use) const {
        auto run = polygons.begin();
        for (std::size_t i = 0; i < triangles.size();) {
            const bool isPolygon = run != polygons.end() && run->first == i;
            const std::size_t count = isPolygon ? (run++)->count : 1;
            use(triangles.subspan(i, count));
            i += count;
        }
    }

    /// Returns the number of faces of this block, if it does not come from strips.
    std::uint64_t faceCount() const {
        std::uint64_t count = triangles.size() + notAPolygon;
        for (const PolygonRun& run : polygons)
            count -= run.count - 1;
        return count;
    }
};

/// The positions of rows in the files of a source, for random access. All processes that open the same source can share
/// it.
struct RowIndex {
    static constexpr std::uint64_t kRows = std::uint64_t{1} << 16U; ///< number of rows from one place to the next

    /// The position of a row in its file.
    struct Place {
        std::uint64_t offset = 0;   ///< bytes from the start of the file
        std::uint64_t line = 0;     ///< line number, for text
        std::uint64_t triangle = 0; ///< for rows of faces: the number of triangles before the row
    };

    /// The index of one file. An element whose rows all have the same length has one place: its first row.
    struct Part {
        std::vector<Place> vertices;
        std::vector<Place> faces;
        std::uint64_t triangles = 0;
    };

    std::vector<Part> parts;
};

using VertexSink = std::function<void(const VertexBlock&)>;
using TriangleSink = std::function<void(const TriangleBlock&)>;

/// A mesh on disk or in memory that is read in passes. Passes are repeatable and independent of each other. Only one
/// pass may run at a time. A pass throws gnomon::Error with path and byte or line at the first defect. The sink has
/// then already received the blocks before the defect.
class MeshSource {
public:
    MeshSource() = default;
    virtual ~MeshSource() = default;
    MeshSource(const MeshSource&) = delete;
    MeshSource& operator=(const MeshSource&) = delete;
    MeshSource(MeshSource&&) = delete;
    MeshSource& operator=(MeshSource&&) = delete;

    virtual const MeshSummary& summary() const = 0;

    /// Delivers all summary().vertexCount vertices in index order.
    virtual void readVertices(const VertexSink& sink) = 0;

    /// Delivers all triangles in file order. Source indices count from 0 without gaps.
    virtual void readTriangles(const TriangleSink& sink) = 0;

    /// Finds the positions of rows. Call this before ranges are read; it requires MeshSummary::hasRanges. Reads the
    /// elements whose rows have variable lengths in one pass. Returns nothing if the input has a defect; a complete
    /// pass then reports the defect.
    virtual std::optional<RowIndex> indexRows(Progress& /*progress*/) { return RowIndex(); }

    /// Sets the index that indexRows returned for the same input, for example in another process. Throws Error if the
    /// index does not fit this input.
    virtual void takeRowIndex(const RowIndex& /*index*/) {}

    /// Returns the number of triangles of all faces. Requires indexRows or takeRowIndex.
    virtual std::uint64_t triangleCount() const { return summary().faceCount; }

    /// Delivers the vertices [begin, end) in index order. This function is thread-safe, also during a pass.
    virtual void readVertexRange(std::uint64_t /*begin*/, std::uint64_t /*end*/, const VertexSink& /*sink*/) {
        throw Error(summary().path, "its vertices cannot be read in any order");
    }

    /// Delivers the triangles of the faces [begin, end). This function is thread-safe, also during a pass. Returns
    /// false if a face has a defect. Also returns false if a face is not a triangle although the size of the file
    /// implied that all faces are triangles. Only a complete pass can then read the input or report the defect.
    virtual bool readFaceRange(std::uint64_t /*begin*/, std::uint64_t /*end*/, const TriangleSink& /*sink*/) {
        throw Error(summary().path, "its faces cannot be read in any order");
    }

    /// Makes all later passes over files poll `progress`, so that the user can stop them. `progress` must outlive the
    /// passes.
    virtual void pollWith(Progress& /*progress*/) {}

    /// Throws Error if the size or the modification time of an input has changed since it was opened.
    virtual void requireUnchanged() const {}

    /// Returns the place of vertex `vertex` in the input for messages: the path, with line or byte if known.
    virtual std::string whereIs(std::uint64_t /*vertex*/) { return summary().path; }
};

/// Adds cameras to the summary. Adds the perspective cameras or, if there are none, the orthographic cameras, because
/// all keyframes of a path have the same projection. Counts the other cameras as dropped, and also cameras above the
/// max number that a model can store.
inline void takeCameras(const std::vector<Camera>& cameras, MeshSummary& summary) {
    constexpr std::size_t kMaxCameras = 1024;
    bool hasPerspective = false;
    for (const Camera& camera : cameras)
        hasPerspective |= !camera.isParallel();
    for (const Camera& camera : cameras)
        if (camera.isParallel() == hasPerspective)
            ++summary.attributesDropped["orthographic cameras"];
        else if (summary.cameras.size() == kMaxCameras)
            ++summary.attributesDropped["cameras"];
        else
            summary.cameras.push_back(camera);
}

/// Throws Error if an input has no faces and no strips. The counts of `summary` must be set.
inline void requireFaces(const MeshSummary& summary) {
    if (summary.faceCount + summary.stripCount > 0) return;
    throw Error(
        summary.path,
        summary.vertexCount == 0 ? "empty: it has no vertices and no faces"
                                 : "no faces: this is a point cloud; make a mesh of it first");
}

/// Returns whether all three coordinates are finite.
inline bool isFinite(const glm::dvec3& position) {
    // A finite number times 0 is 0, else the product is NaN.
    return position.x * 0 + position.y * 0 + position.z * 0 == 0;
}

/// Throws Error if the position of a vertex that a triangle uses is not finite. Other vertices can have any position:
/// scanners write NaN for points without a measurement.
inline void requireFinite(MeshSource& source, std::uint64_t vertex, const glm::dvec3& position) {
    if (!isFinite(position))
        throw Error(source.whereIs(vertex), "a coordinate of vertex " + std::to_string(vertex) + " is not finite");
}

} // namespace gnomon::read
