// What the binning writes and the chunks read: records by chunk, in streams of a store.
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

/// The most vertices whose numbers have 4 bytes: one that no vertex has is left to mark polygons.
constexpr std::uint64_t kMostNarrow = 0xFFFFFFFF;

/// What of each vertex travels.
struct VertexFormat {
    bool isDouble = false; // positions need more than a float
    bool hasNormals = false;
    bool hasColors = false;
    hierarchy::FieldLayout fields{};
    bool isWide = false; // the source has more than kMostNarrow vertices, so their numbers have 8 bytes instead of 4

    bool hasFields() const { return fields.count() > 0; }

    std::size_t bytes() const {
        return (isWide ? 8U : 4U) + 3 * (isDouble ? sizeof(double) : sizeof(float)) + (hasNormals ? 4U : 0U) +
               (hasColors ? 4U : 0U) + (hasFields() ? 4U : 0U);
    }
};

/// A source vertex on its way to a chunk.
struct ChunkVertex {
    std::uint64_t index = 0; // in the source
    std::uint32_t fields = 0;
    glm::dvec3 position{0}; // as in the source
    std::uint32_t normal = hierarchy::kNoNormal;
    std::uint32_t color = 0xFFFFFFFFU;
};

/// Most bytes of a VertexFormat.
using VertexBytes = std::array<std::byte, 8 + 3 * sizeof(double) + 12>;

/// The record of `vertex`, within `storage`.
std::span<const std::byte> encodeVertex(const ChunkVertex& vertex, const VertexFormat& format, VertexBytes& storage);

/// Appends what encodeVertex made to `vertices`.
void decodeVertices(std::span<const std::byte> records, const VertexFormat& format, std::vector<ChunkVertex>& vertices);

/// Appends the records of a stream to `vertices`; memory for more than these is not asked for.
void appendVertices(
    const scratch::StreamStore& store,
    std::uint32_t stream,
    const VertexFormat& format,
    std::vector<ChunkVertex>& vertices);

/// In a stream of triangles: the next `count` triangles are the fan of one polygon.
constexpr std::uint64_t kPolygonMark = ~std::uint64_t{0}; // then count, then 0

/// That `chunk` needs the vertex `vertex`, which lies in another.
struct VertexRequest {
    std::uint32_t chunk = 0;
    std::uint32_t isOwner = 0; // 1: a triangle of `chunk` has the vertex; 0: it is needed for normals only
    std::uint64_t vertex = 0;

    bool operator==(const VertexRequest&) const = default;

    bool operator<(const VertexRequest& other) const {
        return std::tie(chunk, vertex, isOwner) < std::tie(other.chunk, other.vertex, other.isOwner);
    }
};

/// What the chunk in which a vertex lies tells one that uses it, where the source has no normals.
struct SharedNormal {
    std::uint64_t vertex = 0;
    std::uint32_t normal = hierarchy::kNoNormal;
};

/// Appends the corners of a triangle, or a mark, to `stream`.
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

/// How many triangles and marks a stream has.
std::uint64_t triangleRecords(const scratch::StreamStore& store, std::uint32_t stream, const VertexFormat& format);

/// Calls `take(corners)` for one triangle or mark of a stream after the other, in the memory of a block.
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

/// Appends the record of `normal` to `bytes`.
void appendNormal(std::vector<std::byte>& bytes, const SharedNormal& normal, const VertexFormat& format);

/// What appendNormal made.
std::vector<SharedNormal> readNormals(
    const scratch::StreamStore& store, std::uint32_t stream, const VertexFormat& format);

/// Why triangles are left out.
struct DroppedTriangles {
    std::uint64_t degenerate = 0;      // two corners at one position of the source
    std::uint64_t collapsedByGrid = 0; // two corners at one position of the grid only
    std::uint64_t doubled = 0;         // the same three positions as an earlier one
};

/// The triangles that have a corner beyond the grid's range, and the box of these corners.
struct Strayed {
    std::uint64_t triangles = 0;
    Box corners;
};

/// How large a part of the model is, with what of others it takes along.
struct PartSize {
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;

    void growTo(const PartSize& other) {
        triangles = std::max(triangles, other.triangles);
        vertices = std::max(vertices, other.vertices);
    }
};

/// The streams of a chunk. What a pass over the source writes:
enum class BinStream : std::uint32_t {
    Vertices,  // that lie in the chunk and are used, by source index
    Triangles, // most of whose corners lie in the chunk, in source order
    Ghosts,    // triangles of other chunks with a corner in this one, in source order; only for sources without normals
    Requests,  // for vertices of this chunk
    Count
};

/// Streams of the whole source behind those of the chunks, in use only while it is binned.
enum class SourceStream : std::uint32_t {
    Polygons,  // that lie in several chunks: the number of their triangles, then the triangles of the fan
    Triangles, // what the polygons are cut into
    Count
};

/// And what chunks then write to each other:
enum class BorderStream : std::uint32_t {
    Vertices, // of other chunks that this one asked for
    Normals,  // SharedNormal of those with triangles of this chunk; only for sources without normals
    Count
};

template <class Kind>
std::uint32_t streamOf(Kind kind, std::uint32_t chunk) {
    return chunk * static_cast<std::uint32_t>(Kind::Count) + static_cast<std::uint32_t>(kind);
}

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
