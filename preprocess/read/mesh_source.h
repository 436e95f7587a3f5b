// The common interface of all input meshes of a build. A MeshSource passes vertices and triangles in blocks. It can
// read the mesh several times, in bounded memory.
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

/// The name under which MeshSummary::attributesDropped counts normals that are infinite or NaN.
constexpr const char* kBadNormals = "normals that are not finite";

/// The properties of an input mesh that are known before its vertices and faces are read. The counts come from the
/// file's header and were checked against the size of the file. Memory estimates may therefore use them, but only
/// reading the whole file can prove that they are correct.
struct MeshSummary {
    std::string path;            ///< path of the input; the paths of several inputs are joined by ", "
    std::uint64_t fileBytes = 0; ///< total size of all inputs
    std::uint64_t vertexCount = 0;
    std::uint64_t faceCount = 0;       ///< number of polygons, with any number of corners
    std::uint64_t stripCount = 0;      ///< number of rows with triangle strips; one row can have several strips
    std::uint64_t likelyTriangles = 0; ///< estimated number of triangles of all faces and strips
    bool hasNormals = false;
    bool hasColors = false;
    bool isDouble = false;           ///< whether the positions need double precision
    bool hasRanges = false;          ///< whether any range of rows can be read without reading the rows before it
    std::vector<std::string> fields; ///< names of the scalar vertex properties that the build reads
    std::uint64_t heldBytes = 0;     ///< memory in bytes that the source uses during its lifetime
    /// Other files that were read because an input refers to them, for example buffers, images and material libraries.
    std::vector<std::string> additionalFiles;
    std::map<std::string, std::uint64_t> attributesDropped; ///< data of the input that are not read: name and count
    std::vector<Camera> cameras; ///< cameras of the input's scene; all have the same projection
    /// Notes for the user on ambiguous inputs and on how they were read. Each note is one line that begins with the
    /// path.
    std::vector<std::string> remarks;
    /// Mean number of texels per triangle edge, if textures were sampled at the vertices. The texture's detail between
    /// vertices is lost.
    std::optional<double> texelsPerEdge;
};

/// A block of consecutive vertices of the input. It is valid only during the call of the sink that receives it.
struct VertexBlock {
    std::uint64_t firstVertex = 0;
    /// The positions of all vertices that triangles use are finite. The builder rejects other inputs.
    std::span<const glm::dvec3> positions;
    /// Normals as in the file. A normal that is not finite is zero. The span is empty if the input has no normals.
    std::span<const glm::vec3> normals;
    std::span<const std::uint32_t> colors; ///< RGBA8, red in the lowest byte; empty if the input has no colours
    /// Values of the scalar vertex properties as in the file, vertex by vertex, in the order of MeshSummary::fields.
    std::span<const double> fields;
    /// Number of non-finite normals in this block. It is 0 if the summary has already counted them.
    std::uint64_t badNormals = 0;
};

/// The vertex indices of one triangle. Each index is less than MeshSummary::vertexCount.
using TriangleCorners = std::array<std::uint64_t, 3>;

/// A polygon with more than three corners, stored as a triangle fan in a TriangleBlock. Its triangles are [first, first
/// + count) of the block, and all share the polygon's first corner. The polygon has count + 2 corners: the first two
/// corners of triangle `first`, and the last corner of each triangle.
struct PolygonRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// A block of consecutive triangles in file order. It is valid only during the call of the sink that receives it.
///
/// A polygon of n corners becomes n - 2 consecutive triangles in one block. The reader does not know the positions, so
/// it stores a triangle fan from the first corner and lists the fan in `polygons`. A fan is correct only for convex
/// polygons. The code that knows the positions must therefore call PolygonRefiner::refine (polygon.h) for each fan. An
/// out-of-core builder can do this later, after it has joined the positions to the triangles, because a fan contains
/// all corners of its polygon and has consecutive source indices.
struct TriangleBlock {
    std::uint64_t firstTriangle = 0; ///< index in the source of triangles[0]
    std::span<const TriangleCorners> triangles;
    std::span<const PolygonRun> polygons; ///< the triangle fans of polygons, in ascending order of `first`
    /// Number of faces in this block with fewer than three corners. They have no triangles.
    std::uint64_t notAPolygon = 0;

    /// Calls `use(triangles)` for each face of the block. The span has one triangle, or the whole fan of a polygon.
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

    /// Returns the number of faces of this block. It must not be called for triangles of triangle strips.
    std::uint64_t faceCount() const {
        std::uint64_t count = triangles.size() + notAPolygon;
        for (const PolygonRun& run : polygons)
            count -= run.count - 1;
        return count;
    }
};

/// The file positions of every 65536th row (vertex or face), so that readers can start near any row. The positions are
/// valid in all processes that open the same source.
struct RowIndex {
    static constexpr std::uint64_t kRows = std::uint64_t{1} << 16U; ///< number of rows between two stored positions

    /// The position of a row (a vertex or a face) in its file.
    struct Place {
        std::uint64_t offset = 0;   ///< bytes from the start of the file
        std::uint64_t line = 0;     ///< line number, for text files
        std::uint64_t triangle = 0; ///< only for faces: number of triangles before this row
    };

    /// The row positions of one file. If all rows of an element have the same length, only the position of its first
    /// row is stored.
    struct Part {
        std::vector<Place> vertices;
        std::vector<Place> faces;
        std::uint64_t triangles = 0;
    };

    std::vector<Part> parts;
};

using VertexSink = std::function<void(const VertexBlock&)>;
using TriangleSink = std::function<void(const TriangleBlock&)>;

/// A mesh on disk or in memory that can be read several times. Each pass reads it from the start, independently of
/// other passes. Only one pass may run at a time. At the first defect of the file, a pass throws Error with the path
/// and the byte or line. The sink has then already received the blocks before the defect.
class MeshSource {
public:
    MeshSource() = default;
    virtual ~MeshSource() = default;
    MeshSource(const MeshSource&) = delete;
    MeshSource& operator=(const MeshSource&) = delete;
    MeshSource(MeshSource&&) = delete;
    MeshSource& operator=(MeshSource&&) = delete;

    virtual const MeshSummary& summary() const = 0;

    /// Passes all vertices to `sink` in index order.
    virtual void readVertices(const VertexSink& sink) = 0;

    /// Passes all triangles to `sink` in file order. Their source indices count from 0 without gaps.
    virtual void readTriangles(const TriangleSink& sink) = 0;

    /// Returns the file positions of rows, which readVertexRange and readFaceRange require. MeshSummary::hasRanges must
    /// be true. If rows have variable lengths, the function reads them once. Returns nullopt if the input has a defect.
    /// Reading the whole file then reports the defect.
    virtual std::optional<RowIndex> indexRows(Progress& /*progress*/) { return RowIndex(); }

    /// Sets the row positions that indexRows returned for the same input, for example in another process. Throws Error
    /// if `index` does not fit this input.
    virtual void takeRowIndex(const RowIndex& /*index*/) {}

    /// Returns the number of triangles of all faces. indexRows or takeRowIndex must have been called before.
    virtual std::uint64_t triangleCount() const { return summary().faceCount; }

    /// Passes the vertices [begin, end) to `sink` in index order. Thread-safe, also while readVertices or readTriangles
    /// runs.
    virtual void readVertexRange(std::uint64_t /*begin*/, std::uint64_t /*end*/, const VertexSink& /*sink*/) {
        throw Error(summary().path, "its vertices cannot be read in any order");
    }

    /// Passes the triangles of the faces [begin, end) to `sink`. Thread-safe, also while readVertices or readTriangles
    /// runs. Returns false in two cases: a face has a defect, or a face is not a triangle although the size of the file
    /// implied that all faces are triangles. The caller must then read the whole file, which succeeds or reports the
    /// defect.
    virtual bool readFaceRange(std::uint64_t /*begin*/, std::uint64_t /*end*/, const TriangleSink& /*sink*/) {
        throw Error(summary().path, "its faces can only be read in sequence");
    }

    /// Makes all later reads of files poll `progress`, so that the user can interrupt them. `progress` must outlive the
    /// reads.
    virtual void pollWith(Progress& /*progress*/) {}

    /// Throws Error if the size or modification time of an input file has changed since the file was opened.
    virtual void requireUnchanged() const {}

    /// Returns the place of vertex `vertex` in the input, for messages: the path, and the line or byte if known.
    virtual std::string whereIs(std::uint64_t /*vertex*/) { return summary().path; }
};

/// Adds the perspective cameras of `cameras` to `summary`. If there are none, it adds the orthographic cameras. The two
/// types are never mixed, because all keyframes of a camera path must have the same projection. The remaining cameras
/// count as dropped, as do cameras above the max number that a model can store.
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

/// Throws Error if the input has no faces and no triangle strips, according to the counts in `summary`.
inline void requireFaces(const MeshSummary& summary) {
    if (summary.faceCount + summary.stripCount > 0) return;
    throw Error(
        summary.path,
        summary.vertexCount == 0 ? "empty: it has no vertices and no faces"
                                 : "no faces: this is a point cloud; make a mesh of it first");
}

/// Returns true if all three coordinates of `position` are finite.
inline bool isFinite(const glm::dvec3& position) {
    // A finite number times 0 is 0. Infinity or NaN times 0 is NaN.
    return position.x * 0 + position.y * 0 + position.z * 0 == 0;
}

/// Throws Error if `position` is not finite. It must be the position of a vertex that a triangle uses. Unused vertices
/// may have any position, because scanners write NaN for points without a measurement.
inline void requireFinite(MeshSource& source, std::uint64_t vertex, const glm::dvec3& position) {
    if (!isFinite(position))
        throw Error(source.whereIs(vertex), "a coordinate of vertex " + std::to_string(vertex) + " is not finite");
}

} // namespace gnomon::read
