// The vertices that a chunk has and uses, joined by snapped position.
#pragma once

#include "preprocess/chunk/indexed_vertices.h"

namespace gnomon::chunk {

/// Places are welded positions, numbered from 0 in the order of the vertices, so those that lie in the chunk come
/// first.
class ChunkVertices {
public:
    ChunkVertices(IndexedVertices vertices, const hierarchy::Grid& grid);

    std::size_t size() const { return vertices_.size(); }

    const ChunkVertex& operator[](std::uint32_t vertex) const { return vertices_[vertex]; }

    const IndexedVertices& indexed() const { return vertices_; }

    /// The place of the vertex with this index in the source; a check fails for a vertex that the chunk has not.
    std::uint32_t placeOfSource(std::uint64_t sourceIndex) const { return placeOf_[vertices_.find(sourceIndex)]; }

    std::uint32_t placeOf(std::uint32_t vertex) const { return placeOf_[vertex]; }

    simplify::Triangle placesOf(const simplify::Triangle& t) const {
        return {placeOf_[t[0]], placeOf_[t[1]], placeOf_[t[2]]};
    }

    const std::vector<hierarchy::GridPoint>& places() const { return places_; }

    /// How many of the places lie in the chunk.
    std::uint32_t ownPlaces() const { return ownPlaces_; }

private:
    IndexedVertices vertices_;
    std::vector<std::uint32_t> placeOf_;
    std::vector<hierarchy::GridPoint> places_;
    std::uint32_t ownPlaces_ = 0;
};

/// The triangles of three different places, each once, in order; `dropped` counts the others. All of vertices here.
std::vector<simplify::Triangle> keptTriangles(
    const ChunkVertices& vertices, const std::vector<simplify::Triangle>& triangles, DroppedTriangles& dropped);

/// For each place whether other chunks may have triangles there: own ones of which `requests` say so, and all that lie
/// in other chunks.
std::vector<std::uint8_t> sharedPlaces(const ChunkVertices& vertices, std::span<const VertexRequest> requests);

} // namespace gnomon::chunk
