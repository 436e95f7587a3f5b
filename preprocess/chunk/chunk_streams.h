// The records of vertices and triangles in which a source mesh is sorted into chunks. Each chunk has one byte stream
// per kind of record.
#pragma once

#include "core/box.h"
#include "hierarchy/page_fields.h"
#include "preprocess/read/mesh_source.h"
#include "preprocess/scratch/stream_store.h"
#include "preprocess/simplify/mesh.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace gnomon::chunk {

/// The max number of source vertices for vertex numbers of 4 bytes. The number 0xFFFFFFFF is not a vertex, because it
/// marks polygons.
constexpr std::uint64_t kMaxNarrowIndex = 0xFFFFFFFF;

/// The format of a vertex record, which depends on the attributes of the source mesh.
struct VertexFormat {
    bool isDouble = false; // whether positions are doubles, because floats would lose precision
    bool hasNormals = false;
    bool hasColors = false;
    hierarchy::FieldLayout fields{};
    // Whether vertex numbers have 8 bytes instead of 4. This is the case if the source has more than kMaxNarrowIndex
    // vertices.
    bool isWide = false;

    bool hasFields() const { return fields.count() > 0; }

    std::size_t bytes() const {
        return (isWide ? 8U : 4U) + 3 * (isDouble ? sizeof(double) : sizeof(float)) + (hasNormals ? 4U : 0U) +
               (hasColors ? 4U : 0U) + (hasFields() ? 4U : 0U);
    }
};

/// A vertex of the source mesh, decoded from the stream of a chunk.
struct ChunkVertex {
    std::uint64_t index = 0; // index of the vertex in the source
    std::uint32_t fields = 0;
    glm::dvec3 position{0}; // position in the axes and unit of the source
    std::uint32_t normal = hierarchy::kNoNormal;
    std::uint32_t color = 0xFFFFFFFFU;
};

/// A buffer that is large enough for every format of a vertex record.
using VertexBytes = std::array<std::byte, 8 + 3 * sizeof(double) + 12>;

/// Encodes `vertex` as a record into `storage` and returns the bytes of the record.
std::span<const std::byte> encodeVertex(const ChunkVertex& vertex, const VertexFormat& format, VertexBytes& storage);

/// Decodes vertex records that encodeVertex wrote, and appends the vertices to `vertices`.
void decodeVertices(std::span<const std::byte> records, const VertexFormat& format, std::vector<ChunkVertex>& vertices);

/// Decodes all vertex records of a stream and appends the vertices to `vertices`. The vector reserves exactly the
/// memory that it needs.
void appendVertices(
    const scratch::StreamStore& store,
    std::uint32_t stream,
    const VertexFormat& format,
    std::vector<ChunkVertex>& vertices);

/// The first number of a polygon mark in a stream of triangles. The second number of the mark is a count, and the third
/// is 0. The next `count` triangles are the fan of one polygon.
constexpr std::uint64_t kPolygonMark = ~std::uint64_t{0};

/// A request by the chunk `chunk` for the vertex `vertex` of another chunk.
struct VertexRequest {
    std::uint32_t chunk = 0;
    std::uint32_t isOwner = 0; // 1: a triangle of `chunk` uses the vertex; 0: only normals of `chunk` depend on it
    std::uint64_t vertex = 0;

    bool operator==(const VertexRequest&) const = default;

    bool operator<(const VertexRequest& other) const {
        return std::tie(chunk, vertex, isOwner) < std::tie(other.chunk, other.vertex, other.isOwner);
    }
};

/// The normal of a vertex that several chunks use. The chunk that contains the vertex sends the normal to the other
/// chunks. Only sources without normals need such records.
struct SharedNormal {
    std::uint64_t vertex = 0;
    std::uint32_t normal = hierarchy::kNoNormal;
};

/// Appends the three corners of a triangle, or a polygon mark, to the stream with the number `stream`.
inline void putTriangle(
    scratch::StreamStore& store,
    std::uint32_t stream,
    const read::TriangleCorners& corners,
    const VertexFormat& format) {
    if (format.isWide) return store.put(stream, corners);
    store.put(
        stream,
        simplify::Triangle{
            static_cast<std::uint32_t>(corners[0]),
            static_cast<std::uint32_t>(corners[1]),
            static_cast<std::uint32_t>(corners[2])});
}

/// Returns the number of records in a stream of triangles, including polygon marks.
std::uint64_t triangleRecords(const scratch::StreamStore& store, std::uint32_t stream, const VertexFormat& format);

/// Calls `take(corners)` for each triangle or polygon mark of a stream, in order. Only one block of the stream is in
/// memory.
template <class Take>
void forEachTriangle(
    const scratch::StreamStore& store, std::uint32_t stream, const VertexFormat& format, const Take& take) {
    store.readBlocks(stream, [&](std::span<const std::byte> bytes) {
        if (format.isWide) return scratch::forEachRecord<read::TriangleCorners>(bytes, take);
        scratch::forEachRecord<simplify::Triangle>(bytes, [&](const simplify::Triangle& t) {
            constexpr auto kMark = static_cast<std::uint32_t>(kPolygonMark);
            take(read::TriangleCorners{t[0] == kMark ? kPolygonMark : t[0], t[1], t[2]});
        });
    });
}

void putRequest(
    scratch::StreamStore& store, std::uint32_t stream, const VertexRequest& request, const VertexFormat& format);

std::vector<VertexRequest> readRequests(
    const scratch::StreamStore& store, std::uint32_t stream, const VertexFormat& format);

/// Encodes a shared normal and appends its record to `bytes`.
void appendNormal(std::vector<std::byte>& bytes, const SharedNormal& normal, const VertexFormat& format);

/// Reads all shared normals of a stream, which appendNormal encoded.
std::vector<SharedNormal> readNormals(
    const scratch::StreamStore& store, std::uint32_t stream, const VertexFormat& format);

/// The number of source triangles that the model does not contain, by reason.
struct DroppedTriangles {
    std::uint64_t degenerate = 0;      // two corners have the same position in the source
    std::uint64_t collapsedByGrid = 0; // two corners have the same position only after snapping to the grid
    std::uint64_t doubled = 0;         // has the same three positions as an earlier triangle
};

/// The number of triangles with a corner outside the range of the grid, and the bounds of all such corners.
struct Strayed {
    std::uint64_t triangles = 0;
    Box corners;
};

/// The numbers of triangles and vertices of a part of the model. They include the triangles and vertices of other parts
/// that this part needs.
struct PartSize {
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;

    void growTo(const PartSize& other) {
        triangles = std::max(triangles, other.triangles);
        vertices = std::max(vertices, other.vertices);
    }
};

/// The byte streams of each chunk, which the sorting of the source writes.
enum class BinStream : std::uint32_t {
    Vertices,  // the vertices of the chunk that triangles use, in source order
    Triangles, // the triangles that belong to the chunk, in source order
    Ghosts, // triangles of other chunks with a corner in this chunk, in source order; only if the source has no normals
    Requests, // requests of other chunks for vertices of this chunk (VertexRequest)
    Count
};

/// Temporary byte streams of the whole source, which exist only while it is sorted into chunks. Their stream numbers
/// follow those of the chunks.
enum class SourceStream : std::uint32_t {
    Polygons,  // polygons whose corners are in several chunks: the number of triangles, then the triangles of the fan
    Triangles, // the final triangulation of the polygons in the stream Polygons
    Count
};

/// The byte streams of each chunk that receive data from other chunks.
enum class BorderStream : std::uint32_t {
    Vertices, // vertices of other chunks that this chunk requested
    Normals,  // SharedNormal records for vertices that triangles of this chunk use; only if the source has no normals
    Count
};

template <class Kind>
std::uint32_t streamOf(Kind kind, std::uint32_t chunk) {
    return chunk * static_cast<std::uint32_t>(Kind::Count) + static_cast<std::uint32_t>(kind);
}

/// Returns the number of a stream that belongs to the whole source. `chunks` is the number of chunks.
inline std::uint32_t streamOf(SourceStream kind, std::uint32_t chunks) {
    return chunks * static_cast<std::uint32_t>(BinStream::Count) + static_cast<std::uint32_t>(kind);
}

constexpr std::uint32_t binStreams(std::uint32_t chunks) {
    return chunks * static_cast<std::uint32_t>(BinStream::Count) + static_cast<std::uint32_t>(SourceStream::Count);
}

constexpr std::uint32_t borderStreams(std::uint32_t chunks) {
    return chunks * static_cast<std::uint32_t>(BorderStream::Count);
}

} // namespace gnomon::chunk
