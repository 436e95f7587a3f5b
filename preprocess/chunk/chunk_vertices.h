// The vertices of one chunk, and the vertices of other chunks that it uses. They are welded by snapped position.
#pragma once

#include "preprocess/chunk/indexed_vertices.h"

namespace gnomon::chunk {

/// The vertices of a chunk, each with a place (the index of its welded position). Places are numbered from 0 in the
/// order of the vertices. The places in the chunk therefore precede the places of other chunks.
class ChunkVertices {
public:
    ChunkVertices(IndexedVertices vertices, const hierarchy::Grid& grid);

    std::size_t size() const { return vertices_.size(); }

    const ChunkVertex& operator[](std::uint32_t vertex) const { return vertices_[vertex]; }

    const IndexedVertices& indexed() const { return vertices_; }

    /// Returns the place (welded position) of the vertex with the index `sourceIndex` in the source. A check fails if
    /// the chunk neither contains nor uses the vertex.
    std::uint32_t placeOfSource(std::uint64_t sourceIndex) const { return placeOf_[vertices_.find(sourceIndex)]; }

    std::uint32_t placeOf(std::uint32_t vertex) const { return placeOf_[vertex]; }

    simplify::Triangle placesOf(const simplify::Triangle& t) const {
        return {placeOf_[t[0]], placeOf_[t[1]], placeOf_[t[2]]};
    }

    const std::vector<hierarchy::GridPoint>& places() const { return places_; }

    /// Returns the number of places (welded positions) that lie in the chunk itself.
    std::uint32_t ownPlaces() const { return ownPlaces_; }

private:
    IndexedVertices vertices_;
    std::vector<std::uint32_t> placeOf_;
    std::vector<hierarchy::GridPoint> places_;
    std::uint32_t ownPlaces_ = 0;
};

/// Removes degenerate triangles, which have two equal positions, and repeated triangles. Returns the other triangles in
/// order. Their corners are vertex indices of `vertices`. `dropped` counts the removed triangles.
std::vector<simplify::Triangle> keptTriangles(
    const ChunkVertices& vertices, const std::vector<simplify::Triangle>& triangles, DroppedTriangles& dropped);

/// Returns one flag per place (welded position): 1 if triangles of other chunks may use the place. All places outside
/// the chunk are shared. A place in the chunk is shared if `requests` contains a request of another chunk for a vertex
/// there.
std::vector<std::uint8_t> sharedPlaces(const ChunkVertices& vertices, std::span<const VertexRequest> requests);

} // namespace gnomon::chunk
