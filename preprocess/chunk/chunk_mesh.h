// One chunk of a binned source as a welded mesh: a pure function of the chunk's streams.
#pragma once

#include "preprocess/chunk/binned_source.h"
#include "preprocess/chunk/chunk_vertices.h"

namespace gnomon::chunk {

/// Triangles of vertices of a chunk, in source order, polygons triangulated.
struct ChunkTriangles {
    std::vector<simplify::Triangle> own;
    std::vector<simplify::Triangle> ghosts; // of other chunks, that touch places of this one
};

IndexedVertices readVertices(const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk);

/// Polls `progress` while it triangulates polygons.
ChunkTriangles readTriangles(
    const BinnedSource& source, std::uint32_t chunk, const IndexedVertices& vertices, Progress& progress);

/// The faces whose normals count, on places: own ones, then ghosts.
std::vector<simplify::Triangle> facesForNormals(
    const ChunkVertices& vertices,
    const std::vector<simplify::Triangle>& own,
    const std::vector<simplify::Triangle>& ghosts);

struct ChunkMesh {
    simplify::Mesh mesh;
    DroppedTriangles dropped;
    Box bounds;              // of the mesh's positions, world space
    bool hasNormals = false; // some vertex has one, from the source or smoothed
};

/// The chunk's triangles, welded by snapped position, with what its neighbours told of its border. Polls `progress`.
ChunkMesh loadChunk(
    const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk, Progress& progress);

} // namespace gnomon::chunk
