// A page as it lies in memory once decoded: whole groups of clusters of one level, their geometry and what refines
// them.
#pragma once

#include "hierarchy/grid.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace gnomon::hierarchy {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

/// No source normal and no smooth one: the shader takes the face's.
constexpr std::uint32_t kNoNormal = 0x80008000U;

/// A corner of a cluster. Vertices with the same position are welded; those whose normal or colour differ stay apart.
struct Vertex {
    GridPoint position;
    std::uint32_t normal = kNoNormal;  // octahedral, two snorm16 (x low, y high), or kNoNormal
    std::uint32_t color = 0xFFFFFFFFU; // RGBA8, red in the low byte
    auto operator<=>(const Vertex&) const = default;
};

/// A group's address: the page that holds it and its index there.
struct GroupRef {
    std::uint32_t page = kNone;
    std::uint32_t group = kNone;
    auto operator<=>(const GroupRef&) const = default;
};

/// The finer group from which some clusters of this page were simplified; drawn in their place when it is refined.
/// Bounds and errors are copies of that group's own, so that the decision needs nothing but this page.
struct Refinement {
    GroupRef group;
    Sphere bounds; // local space
    double error = 0;
    double attributeError = 0;

    /// As Group::drawnError.
    double drawnError() const { return std::max(error, attributeError); }
};

/// At most 128 triangles (the build's --cluster-triangles) over at most 256 vertices.
struct Cluster {
    std::uint32_t firstVertex = 0;
    std::uint32_t firstTriangle = 0;
    std::uint32_t vertexCount = 0;
    std::uint32_t triangleCount = 0;
    std::uint32_t refinement = kNone; // index into Page::refinements; kNone at level 0
    GridBox box;                      // of its vertices
};

/// Clusters that are simplified together. A group is REFINED in a view if `drawnError`, seen from the eye at the
/// distance of `bounds`, is too large to draw what replaces it; a root group (error infinite) always is.
/// A cluster is drawn exactly if its own group is refined and its refinement, if it has one, is not.
/// Along every chain of refinement neither error decreases and bounds nest towards the root.
struct Group {
    std::uint32_t firstCluster = 0;
    std::uint32_t clusterCount = 0;
    GridBox box;   // of its clusters' vertices: for culling
    Sphere bounds; // local space, encloses `box` and the bounds of all its clusters' refinements: for the error
    double error = std::numeric_limits<double>::infinity(); // world units: what drawing the coarser clusters costs
    double attributeError = 0; // world units: how far what is coloured or shaded wrongly reaches, if that is seen

    /// What a cut obeys: the larger of both.
    double drawnError() const { return std::max(error, attributeError); }
};

using Triangle = std::array<std::uint8_t, 3>; // vertex indices within the cluster

/// A decoded page. Clusters of a group are contiguous and so are the vertices and triangles of a cluster.
struct Page {
    std::uint32_t level = 0; // 0 is the source's detail
    std::vector<Group> groups;
    std::vector<Cluster> clusters;
    std::vector<Refinement> refinements;
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
};

} // namespace gnomon::hierarchy
