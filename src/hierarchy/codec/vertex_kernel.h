// Reconstructs the vertices of a cluster from their stored differences, with SIMD instructions.
#pragma once

#include "hierarchy/codec/vertex_numbers.h"
#include "hierarchy/validation.h"

namespace gnomon::hierarchy {

/// The vertices of one cluster during decoding. Vertex i is at the index i + 1. Index 0 contains the prediction of the
/// first vertex.
struct ClusterVertices {
    std::array<PositionWords, kMaxClusterVertices + 1> positions;
    std::array<std::uint64_t, kMaxClusterVertices + 1> normals; // in the format of joinedNormal
    std::array<std::uint32_t, kMaxClusterVertices + 1> colors;
};

/// The vertices of a cluster that are stored as differences from a prediction, not as references to earlier vertices.
struct FreshVertices {
    std::span<const std::uint32_t> vertices; // indices in the page
    std::span<const PositionWords> positions;
    std::span<const std::uint64_t> normals; // empty without normals
    std::span<const std::uint32_t> colors;  // empty without colours
    std::uint64_t normalMask = 0;           // joinedNormal of the significant bits of each component
    std::uint32_t first = 0;                // index in the page of the cluster's first vertex
    // The edge word of each vertex from decodeConnectivity. The words are read in whole SIMD vectors.
    std::span<const std::uint32_t> edges;
};

/// Computes the `fresh` vertices of `cluster` from their predictions and differences. The entry 0 and the entries of
/// vertices that refer to earlier ones must already be filled.
void predictVertices(const FreshVertices& fresh, ClusterVertices& cluster);

/// Copies the vertices of a cluster to `vertices` and returns their bounding box.
GridBox storeVertices(const ClusterVertices& cluster, const NormalCode& code, std::span<Vertex> vertices);

} // namespace gnomon::hierarchy
