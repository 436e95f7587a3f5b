// What every input looks like to the builder: a mesh that is read in streams, as often as wanted, in bounded memory.
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

/// The name under which all readers count normals that are not finite.
constexpr const char* kBadNormals = "normals that are not finite";

/// What is known before the body is read. Counts are the header's: checked against the file's size, so they may size
/// an estimate, but still unproved until a pass has ended.
struct MeshSummary {
    std::string path;            ///< of the input; several inputs are joined by ", "
    std::uint64_t fileBytes = 0; ///< of all inputs
    std::uint64_t vertexCount = 0;
    std::uint64_t faceCount = 0;       ///< polygons of any number of corners
    std::uint64_t stripCount = 0;      ///< lists of triangle strips
    std::uint64_t likelyTriangles = 0; ///< what the faces and strips come to if their bytes are what they seem
    bool hasNormals = false;
    bool hasColors = false;
    bool isDouble = false;                 ///< positions need more than a float
    bool hasRanges = false;                ///< its rows can be read from anywhere, see MeshSource::indexRows
    std::vector<std::string> fields;       ///< scalar properties of the vertices that are read
    std::uint64_t heldBytes = 0;           ///< of memory that the source keeps as long as it lives
    std::vector<std::string> filesBesides; ///< that an input refers to and that were read: buffers, images
    std::map<std::string, std::uint64_t> attributesDropped; ///< what the input has besides, and how many have it
    std::vector<Camera> cameras;                            ///< of the input's scene, all of one projection
    std::vector<std::string> remarks; ///< how inputs were understood where that is no rule, a line each with its path
    std::optional<double> texelsPerEdge; ///< of textures that were looked up at vertices: what is between is lost
};

/// Consecutive vertices. Valid only during the call of the sink.
struct VertexBlock {
    std::uint64_t firstVertex = 0;
    std::span<const glm::dvec3> positions; ///< finite where a triangle uses them, else the source is bad
    std::span<const glm::vec3> normals;    ///< as stored, zero where not finite; empty if the input has none
    std::span<const std::uint32_t> colors; ///< RGBA8, red in the lowest byte; empty if the input has none
    std::span<const double> fields;        ///< as many as the summary has a vertex, vertex by vertex, as stored
    std::uint64_t badNormals = 0;          ///< normals that are not finite, if the summary does not count them
};

/// The vertex indices of one triangle, each below the summary's vertexCount.
using TriangleCorners = std::array<std::uint64_t, 3>;

/// A polygon of more than three corners inside a TriangleBlock: triangles [first, first + count) of the block are its
/// fan from corner 0, so the polygon has count + 2 corners: both ends of triangle `first`, then each last corner.
struct PolygonRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Consecutive triangles in file order. Valid only during the call of the sink.
///
/// A polygon of n corners is n - 2 consecutive triangles and never straddles two blocks. The reader has no positions,
/// so it delivers the fan, which is right for convex polygons, and names the run in `polygons`. Whoever holds the
/// positions calls PolygonRefiner::refine (polygon.h) on each run; an out-of-core builder may do so after positions
/// have been joined to the triangles, because the fan holds every corner and the source indices of a run are
/// consecutive.
struct TriangleBlock {
    std::uint64_t firstTriangle = 0; ///< source index of triangles[0]
    std::span<const TriangleCorners> triangles;
    std::span<const PolygonRun> polygons; ///< in ascending order of `first`
    std::uint64_t notAPolygon = 0; ///< faces of fewer than three corners met in this block, which have no triangles

    /// Calls `use` with the triangles of each face in turn: one, or the fan of a polygon.
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

    /// How many faces it came from, where it came from no strips.
    std::uint64_t faceCount() const {
        std::uint64_t count = triangles.size() + notAPolygon;
        for (const PolygonRun& run : polygons)
            count -= run.count - 1;
        return count;
    }
};

/// Where rows of a source lie, for reading from anywhere. All processes that have the source open can share it.
struct RowIndex {
    static constexpr std::uint64_t kRows = std::uint64_t{1} << 16U; ///< from one place to the next

    struct Place {
        std::uint64_t offset = 0;   ///< bytes from the start of the file
        std::uint64_t line = 0;     ///< of text
        std::uint64_t triangle = 0; ///< of faces: how many triangles lie before it
    };

    /// Of one file. Rows of one length have one place, that of the first.
    struct Part {
        std::vector<Place> vertices;
        std::vector<Place> faces;
        std::uint64_t triangles = 0;
    };

    std::vector<Part> parts;
};

using VertexSink = std::function<void(const VertexBlock&)>;
using TriangleSink = std::function<void(const TriangleBlock&)>;

/// One mesh on disk or in memory. Passes are repeatable and independent of each other; one pass at a time.
/// A pass throws gnomon::Error with path and byte or line at the first defect; blocks delivered before stay delivered.
class MeshSource {
public:
    MeshSource() = default;
    virtual ~MeshSource() = default;
    MeshSource(const MeshSource&) = delete;
    MeshSource& operator=(const MeshSource&) = delete;
    MeshSource(MeshSource&&) = delete;
    MeshSource& operator=(MeshSource&&) = delete;

    virtual const MeshSummary& summary() const = 0;

    /// Delivers all vertices in index order, exactly summary().vertexCount of them.
    virtual void readVertices(const VertexSink& sink) = 0;

    /// Delivers all triangles in file order; source indices count from 0 without gaps.
    virtual void readTriangles(const TriangleSink& sink) = 0;

    /// Where the summary's `hasRanges` says so, before ranges are read: finds where rows lie, in a pass over those of
    /// no fixed length. Nothing where the input has a defect: then only a whole pass tells what it is.
    virtual std::optional<RowIndex> indexRows(Progress& /*progress*/) { return RowIndex(); }

    /// Instead of `indexRows`: what it returned for the same input. Throws Error where that cannot be.
    virtual void takeRowIndex(const RowIndex& /*index*/) {}

    /// How many triangles its faces are, once rows are indexed.
    virtual std::uint64_t triangleCount() const { return summary().faceCount; }

    /// The vertices [begin, end), in index order. Safe from many threads at once, and beside passes.
    virtual void readVertexRange(std::uint64_t /*begin*/, std::uint64_t /*end*/, const VertexSink& /*sink*/) {
        throw Error(summary().path, "its vertices cannot be read from anywhere");
    }

    /// Likewise the triangles of the faces [begin, end). False where one has a defect, or is no triangle though the
    /// size of the file told that all are: then only a whole pass tells what the input is.
    virtual bool readFaceRange(std::uint64_t /*begin*/, std::uint64_t /*end*/, const TriangleSink& /*sink*/) {
        throw Error(summary().path, "its faces cannot be read from anywhere");
    }

    /// From now on passes over a file poll `progress`, which must outlive them.
    virtual void pollWith(Progress& /*progress*/) {}

    /// Throws Error if an input is no longer the one that was opened, by its size and the time of its last change.
    virtual void requireUnchanged() const {}

    /// Where vertex `vertex` is in the input, for messages.
    virtual std::string whereIs(std::uint64_t /*vertex*/) { return summary().path; }
};

/// Adds cameras to the summary: those in perspective or, if there are none, the orthographic ones, since all keyframes
/// of a path have the same projection. Counts the other cameras as dropped, and those beyond a number that tables of a
/// model have space for.
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

/// Throws Error if `summary`, whose counts are known, has no faces.
inline void requireFaces(const MeshSummary& summary) {
    if (summary.faceCount + summary.stripCount > 0) return;
    throw Error(
        summary.path,
        summary.vertexCount == 0 ? "empty: it has no vertices and no faces"
                                 : "no faces: this is a point cloud; make a mesh of it first");
}

inline bool isFinite(const glm::dvec3& position) {
    return position.x * 0 + position.y * 0 + position.z * 0 == 0; // a number times zero is zero, anything else is not
}

/// Of a vertex that triangles use, throws Error. Others may lie anywhere: scanners write NaN where they saw nothing.
inline void requireFinite(MeshSource& source, std::uint64_t vertex, const glm::dvec3& position) {
    if (!isFinite(position))
        throw Error(source.whereIs(vertex), "a coordinate of vertex " + std::to_string(vertex) + " is not finite");
}

} // namespace gnomon::read
