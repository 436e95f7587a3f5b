// A decoded page of a model: complete groups of clusters of one level of detail, with their geometry.
#pragma once

#include "hierarchy/grid.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace gnomon::hierarchy {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

/// Marks a vertex that has neither a normal from the source mesh nor a smooth normal. The shader then uses the normal
/// of the triangle.
constexpr std::uint32_t kNoNormal = 0x80008000U;

/// A vertex of a cluster. Vertices with equal position, normal and colour are welded. Vertices with the same position
/// but a different normal or colour remain separate.
struct Vertex {
    GridPoint position;
    std::uint32_t normal = kNoNormal;  // octahedral, two snorm16 (x low, y high), or kNoNormal
    std::uint32_t color = 0xFFFFFFFFU; // RGBA8, red in the low byte
    auto operator<=>(const Vertex&) const = default;
};

/// The address of a group of clusters: its page and its index in the page.
struct GroupRef {
    std::uint32_t page = kNone;
    std::uint32_t group = kNone;
    auto operator<=>(const GroupRef&) const = default;
};

/// A finer group of clusters, from which some clusters of this page were simplified. If this finer group is refined,
/// its clusters are drawn instead of the clusters of this page. Bounds and errors are copies of the values of the finer
/// group, so a cut can test it without loading its page.
struct Refinement {
    GroupRef group;
    Sphere bounds; // local space
    double error = 0;
    double attributeError = 0;

    /// Returns the larger of the geometric error and the attribute error of the finer group, in world units.
    double drawnError() const { return std::max(error, attributeError); }
};

/// A cluster of triangles. It has at most 128 triangles by default (--cluster-triangles of the build) and at most 256
/// vertices.
struct Cluster {
    std::uint32_t firstVertex = 0;
    std::uint32_t firstTriangle = 0;
    std::uint32_t vertexCount = 0;
    std::uint32_t triangleCount = 0;
    // index in Page::refinements of the finer group that the cluster was simplified from; kNone at level 0
    std::uint32_t refinement = kNone;
    GridBox box; // bounding box of its vertices
};

/// A group of clusters that are simplified together. A group is REFINED in a view if its `drawnError`, seen from the
/// distance of `bounds`, is too large for this view. A root group has an infinite error, so it is always refined. A
/// cluster is drawn if its own group is refined, and the finer group that it was simplified from is absent or not
/// refined. Along each path to the root, both errors never decrease, and the `bounds` of each group enclose the
/// `bounds` of the finer groups.
struct Group {
    std::uint32_t firstCluster = 0;
    std::uint32_t clusterCount = 0;
    GridBox box;   // bounding box of the vertices, for culling
    Sphere bounds; // local space, for the error rule; encloses `box` and the bounds of all refinements of the group
    // The max geometric error, in world units, of the coarser clusters that replace this group.
    double error = std::numeric_limits<double>::infinity();
    double attributeError = 0; // size of wrongly coloured or shaded surface, in world units

    /// Returns the error that the selection of detail compares with its limit, in world units. This is the larger of
    /// the geometric error and the attribute error.
    double drawnError() const { return std::max(error, attributeError); }
};

using Triangle = std::array<std::uint8_t, 3>; // vertex indices within the cluster

/// A decoded page of a model. The clusters of a group are contiguous, and so are the vertices and the triangles of a
/// cluster.
struct Page {
    std::uint32_t level = 0; // level 0 is the full detail of the source
    std::vector<Group> groups;
    std::vector<Cluster> clusters;
    std::vector<Refinement> refinements;
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
};

} // namespace gnomon::hierarchy
