// One level of detail during the build, with its triangles, clusters of triangles, and groups of clusters.
#pragma once

#include "core/words.h"
#include "preprocess/levels/color_transfer.h"
#include "preprocess/levels/normal_transfer.h"
#include "preprocess/simplify/mesh.h"
#include "preprocess/simplify/simplify.h"

#include <algorithm>
#include <array>
#include <limits>

namespace gnomon::levels {

/// The method that computes the stored error of a group.
enum class ErrorKind : std::uint8_t {
    Estimated, // estimate of the simplifier; not an upper bound
    Measured,  // upper bound: the sum of the bounds of all collapses
    Tight      // upper bound: the smaller of this sum and the measured two-sided Hausdorff bound
};

inline constexpr std::array kErrorKinds = {
    Word<ErrorKind>{ErrorKind::Estimated, "estimated"},
    Word<ErrorKind>{ErrorKind::Measured, "measured"},
    Word<ErrorKind>{ErrorKind::Tight, "tight"},
};

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity(); // an error limit that permits all errors

/// The build options that affect the hierarchy of clusters. The .gnm file stores them.
struct LevelOptions {
    std::uint32_t clusterTriangles = 128;
    simplify::Simplifier simplifier = simplify::Simplifier::Quadric;
    ErrorKind error = ErrorKind::Measured;
};

/// The location of a group in the model: its level, the page within the level, and the group within the page.
struct GroupPlace {
    std::uint32_t level = 0;
    std::uint32_t page = 0;
    std::uint32_t group = 0;

    bool operator==(const GroupPlace&) const = default;
};

/// The refinement of clusters: the finer group from which the clusters were simplified.
struct LevelRefinement {
    GroupPlace place;
    Sphere bounds;             // local space
    double error = 0;          // world units
    double attributeError = 0; // world units

    double drawnError() const { return std::max(error, attributeError); }
};

/// A mesh vertex that moves to the position of vertex `at` in this level and all coarser levels.
struct MovedVertex {
    std::uint32_t vertex = 0;
    std::uint32_t at = 0;
};

/// A cluster of a level of detail. Its triangles are contiguous in the level's list.
struct LevelCluster {
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
    std::uint32_t vertexCount = 0;
    // Index in Level::refinements of the finer group from which the cluster was simplified.
    std::uint32_t refinement = hierarchy::kNone;
    hierarchy::GridBox box;
};

/// A group of clusters. Its clusters are contiguous in the level's list.
struct LevelGroup {
    std::uint32_t firstCluster = 0;
    std::uint32_t clusterCount = 0;
    hierarchy::GridBox box;
    Sphere bounds;             // local space
    double error = kNoLimit;   // world units; kNoLimit for a root group
    double attributeError = 0; // world units; 0 for a root group
    GroupPlace place;
    bool isDeferred = false; // whether the next level contains its clusters unchanged
};

/// One level of detail. The clusters of a group and the triangles of a cluster are contiguous.
struct Level {
    std::vector<simplify::Triangle> triangles;   // vertex indices of the Mesh
    std::vector<simplify::TriangleError> errors; // error bounds of each triangle
    std::vector<LevelCluster> clusters;
    std::vector<LevelGroup> groups;
    std::vector<LevelRefinement> refinements;
    std::vector<MovedVertex> moved;         // vertices whose position changes at this level
    std::vector<TransferredNormal> normals; // vertices whose normal changes at this level
    std::vector<TransferredWord> colors;    // vertices whose colour changes at this level
    std::vector<TransferredWord> fields;    // vertices whose fields change at this level
};

} // namespace gnomon::levels
