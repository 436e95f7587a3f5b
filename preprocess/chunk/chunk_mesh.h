// Loads one chunk of the source as a mesh with welded vertices. The result depends only on the chunk's streams.
#pragma once

#include "preprocess/chunk/binned_source.h"
#include "preprocess/chunk/chunk_vertices.h"

namespace gnomon::chunk {

/// The triangles of a chunk in the order of the source file. Their corners are vertex indices of the chunk. Polygons
/// are triangulated.
struct ChunkTriangles {
    std::vector<simplify::Triangle> own;
    std::vector<simplify::Triangle> ghosts; // triangles of other chunks with a corner at a position of this chunk
};

/// Reads the vertices of `chunk`, and the vertices of other chunks that the triangles of `chunk` use.
IndexedVertices readVertices(const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk);

/// Reads the triangles of `chunk`, and triangulates its polygons. Polls `progress` meanwhile.
ChunkTriangles readTriangles(
    const BinnedSource& source, std::uint32_t chunk, const IndexedVertices& vertices, Progress& progress);

/// Returns the triangles that contribute to the vertex normals of a chunk. The chunk's own triangles are first, then
/// the triangles of other chunks at its vertices (ghosts). The corners are indices of welded positions (places) instead
/// of vertices.
std::vector<simplify::Triangle> facesForNormals(
    const ChunkVertices& vertices,
    const std::vector<simplify::Triangle>& own,
    const std::vector<simplify::Triangle>& ghosts);

/// One chunk as a mesh with welded vertices, and its statistics.
struct ChunkMesh {
    simplify::Mesh mesh;
    DroppedTriangles dropped;
    Box bounds;              // bounds of the mesh's positions in world space
    bool hasNormals = false; // whether at least one vertex has a normal, from the source or computed from the faces
};

/// Loads `chunk` as a mesh. The function welds vertices that snap to the same grid point. It adds the vertices and
/// normals that neighbouring chunks sent. It polls `progress`.
ChunkMesh loadChunk(
    const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk, Progress& progress);

} // namespace gnomon::chunk
