// Loads one chunk of a binned source as a welded mesh. The result depends only on the chunk's streams.
#pragma once

#include "preprocess/chunk/binned_source.h"
#include "preprocess/chunk/chunk_vertices.h"

namespace gnomon::chunk {

/// The triangles of a chunk in source order. Their corners are vertex indices of the chunk. Polygons are triangulated.
struct ChunkTriangles {
    std::vector<simplify::Triangle> own;
    std::vector<simplify::Triangle> ghosts; // triangles of other chunks with a corner at a position of this chunk
};

/// Reads the vertices of `chunk`, and the vertices of other chunks that `chunk` requested.
IndexedVertices readVertices(const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk);

/// Reads the triangles of `chunk`. Polls `progress` while it triangulates polygons.
ChunkTriangles readTriangles(
    const BinnedSource& source, std::uint32_t chunk, const IndexedVertices& vertices, Progress& progress);

/// Returns the triangles that contribute to vertex normals: first the triangles of the chunk, then its ghosts. Their
/// corners are places (welded positions) instead of vertices.
std::vector<simplify::Triangle> facesForNormals(
    const ChunkVertices& vertices,
    const std::vector<simplify::Triangle>& own,
    const std::vector<simplify::Triangle>& ghosts);

/// A chunk as a welded mesh with its statistics.
struct ChunkMesh {
    simplify::Mesh mesh;
    DroppedTriangles dropped;
    Box bounds;              // bounds of the mesh's positions in world space
    bool hasNormals = false; // whether at least one vertex has a normal, from the source or computed from the faces
};

/// Loads `chunk`. The function welds its triangles by snapped position and adds the vertices and normals that its
/// neighbours sent. It polls `progress`.
ChunkMesh loadChunk(
    const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk, Progress& progress);

} // namespace gnomon::chunk
