// One chunk of a binned source as a welded mesh: a pure function of the chunk's streams.
#pragma once

#include "preprocess/chunk/chunk_vertices.h"

namespace gnomon::preprocess {

/// Triangles of vertices of a chunk, in source order, polygons triangulated.
struct ChunkTriangles {
    std::vector<Triangle> own;
    std::vector<Triangle> ghosts; // of other chunks, that touch places of this one
};

IndexedVertices readVertices(const BinnedSource& source, const StreamStore& borders, std::uint32_t chunk);

ChunkTriangles readTriangles(const BinnedSource& source, std::uint32_t chunk, const IndexedVertices& vertices);

/// The faces whose normals count, on places: own ones, then ghosts.
std::vector<Triangle> facesForNormals(
    const ChunkVertices& vertices, const std::vector<Triangle>& own, const std::vector<Triangle>& ghosts);

struct ChunkMesh {
    Mesh mesh;
    DroppedTriangles dropped;
    Box bounds;              // of the mesh's positions, world space
    bool hasNormals = false; // some vertex has one, from the source or smoothed
};

/// The chunk's triangles, welded by snapped position, with what its neighbours told of its border.
ChunkMesh loadChunk(const BinnedSource& source, const StreamStore& borders, std::uint32_t chunk);

} // namespace gnomon::preprocess
