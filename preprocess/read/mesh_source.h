// The interface of all inputs of a build. A MeshSource streams the vertices and triangles of a mesh in repeatable
// passes and in bounded memory.
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

/// The properties of an input before its body is read. The counts come from the header. They were checked against the
/// size of the file, so estimates of memory may use them. Only a complete pass can prove that they are correct.
struct MeshSummary {
    std::string path;            ///< path of the input; the paths of several inputs are joined by ", "
    std::uint64_t fileBytes = 0; ///< total size of all inputs
    std::uint64_t vertexCount = 0;
    std::uint64_t faceCount = 0;       ///< number of polygons with any number of corners
    std::uint64_t stripCount = 0;      ///< number of rows with triangle strips; a row can have several strips
    std::uint64_t likelyTriangles = 0; ///< estimated number of triangles of all faces and strips
    bool hasNormals = false;
    bool hasColors = false;
    bool isDouble = false;           ///< whether positions need double precision
    bool hasRanges = false;          ///< whether rows can be read in any order, see MeshSource::indexRows
    std::vector<std::string> fields; ///< names of the scalar vertex properties that are read
    std::uint64_t heldBytes = 0;     ///< memory that the source uses during its lifetime
    /// Other files that were read because an input refers to them, for example buffers, images and material libraries.
    std::vector<std::string> additionalFiles;
    std::map<std::string, std::uint64_t> attributesDropped; ///< data of the input that is not read: name and count
    std::vector<Camera> cameras; ///< cameras of the input's scene; all have the same projection
    /// Notes on ambiguous inputs and on how they were read. Each note is one line and begins with the path.
    std::vector<std::string> remarks;
    /// Mean number of texels per triangle edge, if textures were sampled at the vertices. Texture detail between
    /// vertices is lost.
    std::optional<double> texelsPerEdge;
};

/// A block of consecutive vertices. The block is valid only during the call of the sink.
struct VertexBlock {
    std::uint64_t firstVertex = 0;
    /// Positions are finite for all vertices that triangles use. The builder rejects other sources.
    std::span<const glm::dvec3> positions;
    std::span<const glm::vec3> normals;    ///< as stored; zero if not finite; empty if the input has no normals
    std::span<const std::uint32_t> colors; ///< RGBA8, red in the lowest byte; empty if the input has no colours
    /// Field values as stored, vertex by vertex: one value per name in MeshSummary::fields.
    std::span<const double> fields;
    std::uint64_t badNormals = 0; ///< number of non-finite normals in this block, if the summary does not count them
};

/// The vertex indices of one triangle, each below the summary's vertexCount.
using TriangleCorners = std::array<std::uint64_t, 3>;

/// A polygon with more than three corners in a TriangleBlock. The triangles [first, first + count) of the block are the
/// fan from the polygon's first corner. The polygon has count + 2 corners: the first two corners of triangle `first`,
/// and the last corner of each triangle.
struct PolygonRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// A block of consecutive triangles in file order. The block is valid only during the call of the sink. A polygon of n
/// corners becomes n - 2 consecutive triangles in one block. The reader does not know the positions, so it delivers the
/// fan from the first corner and lists the fan in `polygons`. A fan is correct only for convex polygons. The code that
/// knows the positions must call PolygonRefiner::refine (polygon.h) for each fan. An out-of-core builder can do this
/// later, after it has joined the positions to the triangles. This is possible because a fan contains all corners of
/// its polygon and its triangles have consecutive source indices.
struct TriangleBlock {
    std::uint64_t firstTriangle = 0; ///< source index of triangles[0]
    std::span<const TriangleCorners> triangles;
    std::span<const PolygonRun> polygons; ///< in ascending order of `first`
    /// Number of faces in this block with fewer than three corners. Such faces have no triangles.
    std::uint64_t notAPolygon = 0;

    /// Calls `use(triangles)` for each face. The span contains one triangle, or the fan of a polygon.
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

    /// Returns the number of faces of this block. The block must not come from strips.
    std::uint64_t faceCount() const {
        std::uint64_t count = triangles.size() + notAPolygon;
        for (const PolygonRun& run : polygons)
            count -= run.count - 1;
        return count;
    }
};

/// The positions of rows in the files of a source, for random access. All processes that open the same source can use
/// the same index.
struct RowIndex {
    static constexpr std::uint64_t kRows = std::uint64_t{1} << 16U; ///< number of rows between two places

    /// The position of a row in its file.
    struct Place {
        std::uint64_t offset = 0;   ///< bytes from the start of the file
        std::uint64_t line = 0;     ///< line number, for text
        std::uint64_t triangle = 0; ///< only for faces: number of triangles before the row
    };

    /// The index of one file. If all rows of an element have the same length, the element has only one place, the place
    /// of its first row.
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
/// pass may run at a time. At the first defect, a pass throws gnomon::Error with the path and the byte or line. The
/// sink has then already received the blocks before the defect.
class MeshSource {
public:
    MeshSource() = default;
    virtual ~MeshSource() = default;
    MeshSource(const MeshSource&) = delete;
    MeshSource& operator=(const MeshSource&) = delete;
    MeshSource(MeshSource&&) = delete;
    MeshSource& operator=(MeshSource&&) = delete;

    virtual const MeshSummary& summary() const = 0;

    /// Passes all summary().vertexCount vertices to `sink` in index order.
    virtual void readVertices(const VertexSink& sink) = 0;

    /// Passes all triangles to `sink` in file order. Their source indices count from 0 without gaps.
    virtual void readTriangles(const TriangleSink& sink) = 0;

    /// Finds the positions of rows and returns their index. It must be called before ranges are read, and it requires
    /// MeshSummary::hasRanges. The function makes one pass over elements whose rows have variable lengths. Returns
    /// nullopt if the input has a defect. A complete pass then reports the defect.
    virtual std::optional<RowIndex> indexRows(Progress& /*progress*/) { return RowIndex(); }

    /// Sets the row index that indexRows returned for the same input, for example in another process. Throws Error if
    /// the index does not fit this input.
    virtual void takeRowIndex(const RowIndex& /*index*/) {}

    /// Returns the number of triangles of all faces. Requires indexRows or takeRowIndex.
    virtual std::uint64_t triangleCount() const { return summary().faceCount; }

    /// Passes the vertices [begin, end) to `sink` in index order. This function is thread-safe, also during a pass.
    virtual void readVertexRange(std::uint64_t /*begin*/, std::uint64_t /*end*/, const VertexSink& /*sink*/) {
        throw Error(summary().path, "its vertices cannot be read in any order");
    }

    /// Passes the triangles of the faces [begin, end) to `sink`. This function is thread-safe, also during a pass.
    /// Returns false if a face has a defect. Returns false also if a face is not a triangle although the size of the
    /// file implied that all faces are triangles. Only a complete pass can then read the input or report the defect.
    virtual bool readFaceRange(std::uint64_t /*begin*/, std::uint64_t /*end*/, const TriangleSink& /*sink*/) {
        throw Error(summary().path, "its faces cannot be read in any order");
    }

    /// Makes all later passes over files poll `progress`, so that the user can interrupt them. `progress` must outlive
    /// the passes.
    virtual void pollWith(Progress& /*progress*/) {}

    /// Throws Error if the size or the modification time of an input has changed since it was opened.
    virtual void requireUnchanged() const {}

    /// Returns a text for messages that says where vertex `vertex` is in the input: the path, and the line or byte if
    /// known.
    virtual std::string whereIs(std::uint64_t /*vertex*/) { return summary().path; }
};

/// Adds cameras to the summary. It adds the perspective cameras or, if there are none, the orthographic cameras,
/// because all keyframes of a path must have the same projection. The other cameras count as dropped. Cameras above the
/// max number that a model can store count as dropped too.
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

/// Throws Error if an input has no faces and no strips. The counts of `summary` must already be set.
inline void requireFaces(const MeshSummary& summary) {
    if (summary.faceCount + summary.stripCount > 0) return;
    throw Error(
        summary.path,
        summary.vertexCount == 0 ? "empty: it has no vertices and no faces"
                                 : "no faces: this is a point cloud; make a mesh of it first");
}

/// Returns true if all three coordinates are finite.
inline bool isFinite(const glm::dvec3& position) {
    // A finite number times 0 is 0. Infinity or NaN times 0 is NaN.
    return position.x * 0 + position.y * 0 + position.z * 0 == 0;
}

/// Throws Error if `position`, the position of a vertex that a triangle uses, is not finite. Other vertices may have
/// any position, because scanners write NaN for points without a measurement.
inline void requireFinite(MeshSource& source, std::uint64_t vertex, const glm::dvec3& position) {
    if (!isFinite(position))
        throw Error(source.whereIs(vertex), "a coordinate of vertex " + std::to_string(vertex) + " is not finite");
}

} // namespace gnomon::read
