// Reconstruction of the vertices of one cluster from their stored differences, with vector instructions.
#pragma once

#include "hierarchy/codec/vertex_numbers.h"
#include "hierarchy/validation.h"

namespace gnomon::hierarchy {

/// The vertices of one cluster. Vertex i has the place i + 1. Place 0 contains the prediction of the first vertex.
struct ClusterVertices {
    std::array<PositionWords, kMaxClusterVertices + 1> positions;
    std::array<std::uint64_t, kMaxClusterVertices + 1> normals; // as joinedNormal
    std::array<std::uint32_t, kMaxClusterVertices + 1> colors;
};

/// The vertices of a cluster that are not references, with their differences.
struct FreshVertices {
    std::span<const std::uint32_t> vertices; // their indices in the page
    std::span<const PositionWords> positions;
    std::span<const std::uint64_t> normals; // empty without normals
    std::span<const std::uint32_t> colors;  // empty without colours
    std::uint64_t normalMask = 0;           // joinedNormal of the significant bits of both components
    std::uint32_t first = 0;                // first vertex of the cluster in the page
    // Edge of each vertex of the cluster, as decodeConnectivity returns it. Read in whole vectors.
    std::span<const std::uint32_t> edges;
};

/// Reconstructs the `fresh` vertices in `cluster`. The places of references and place 0 must be filled.
void predictVertices(const FreshVertices& fresh, ClusterVertices& cluster);

/// Copies the vertices of a cluster to `vertices` and returns their box.
GridBox storeVertices(const ClusterVertices& cluster, const NormalCode& code, std::span<Vertex> vertices);

} // namespace gnomon::hierarchy
