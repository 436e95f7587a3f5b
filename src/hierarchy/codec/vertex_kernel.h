// The vertices of one cluster from what is stored of them, in vector lanes.
#pragma once

#include "hierarchy/codec/vertex_numbers.h"
#include "hierarchy/validation.h"

namespace gnomon::hierarchy {

/// The vertices of one cluster, each one place behind its number: place 0 is what the first is predicted from.
struct ClusterVertices {
    std::array<PositionWords, kMaxClusterVertices + 1> positions;
    std::array<std::uint64_t, kMaxClusterVertices + 1> normals; // joinedNormal
    std::array<std::uint32_t, kMaxClusterVertices + 1> colors;
};

/// Those vertices of a cluster that refer to none before it.
struct FreshVertices {
    std::span<const std::uint32_t> vertices; // their numbers, in the page
    std::span<const PositionWords> positions;
    std::span<const std::uint64_t> normals; // empty if there are none
    std::span<const std::uint32_t> colors;  // empty if there are none
    std::uint64_t normalMask = 0;           // joinedNormal of the bits that normals have
    std::uint32_t first = 0;                // the cluster's first vertex in the page
    // By vertex of the cluster, as decodeConnectivity leaves them; read in whole vectors.
    std::span<const std::uint32_t> edges;
};

/// Fills the places of `fresh`; those of references and place 0 must be there.
void predictVertices(const FreshVertices& fresh, ClusterVertices& cluster);

/// Copies the vertices of a cluster to where they belong and returns their box.
GridBox storeVertices(const ClusterVertices& cluster, const NormalCode& code, std::span<Vertex> vertices);

} // namespace gnomon::hierarchy
