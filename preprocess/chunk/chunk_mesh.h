// Loads one chunk of a binned source as a welded mesh. The result is a pure function of the chunk's streams.
#pragma once

#include "preprocess/chunk/binned_source.h"
#include "preprocess/chunk/chunk_vertices.h"

namespace gnomon::chunk {

/// The triangles of a chunk in source order, as vertex indices of the chunk. Polygons are triangulated.
struct ChunkTriangles {
    std::vector<simplify::Triangle> own;
    std::vector<simplify::Triangle> ghosts; // triangles of other chunks that share a place with this chunk
};

/// Reads the vertices of `chunk`, and the vertices of other chunks that it requested.
IndexedVertices readVertices(const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk);

/// Reads the triangles of `chunk`. Polls `progress` while it triangulates polygons.
ChunkTriangles readTriangles(
    const BinnedSource& source, std::uint32_t chunk, const IndexedVertices& vertices, Progress& progress);

/// Returns the faces that contribute to vertex normals, as triangles of places: first own faces, then ghosts.
std::vector<simplify::Triangle> facesForNormals(
    const ChunkVertices& vertices,
    const std::vector<simplify::Triangle>& own,
    const std::vector<simplify::Triangle>& ghosts);

/// A chunk as a welded mesh with its statistics.
struct ChunkMesh {
    simplify::Mesh mesh;
    DroppedTriangles dropped;
    Box bounds;              // bounds of the mesh's positions in world space
    bool hasNormals = false; // whether a vertex has a normal, from the source or smoothed
};

/// Loads `chunk`: welds its triangles by snapped position and adds the border data of its neighbours. Polls `progress`.
ChunkMesh loadChunk(
    const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk, Progress& progress);

} // namespace gnomon::chunk
