// One level of detail while it is built: triangles, clusters of them, groups of clusters.
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

/// How the stored error of a group comes about.
enum class ErrorKind : std::uint8_t {
    Estimated, // what the simplifier claims
    Measured,  // a bound, summed over the collapses
    Tight      // a bound of what they came to, where that is lower
};

inline constexpr std::array kErrorKinds = {
    Word<ErrorKind>{ErrorKind::Estimated, "estimated"},
    Word<ErrorKind>{ErrorKind::Measured, "measured"},
    Word<ErrorKind>{ErrorKind::Tight, "tight"},
};

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity(); // of an error

/// What shapes the hierarchy; part of what a .gnm says about itself.
struct LevelOptions {
    std::uint32_t clusterTriangles = 128;
    simplify::Simplifier simplifier = simplify::Simplifier::Quadric;
    ErrorKind error = ErrorKind::Measured;
};

/// Where a group lies: its level, its page within that level's pages, its place in the page.
struct GroupPlace {
    std::uint32_t level = 0;
    std::uint32_t page = 0;
    std::uint32_t group = 0;

    bool operator==(const GroupPlace&) const = default;
};

/// A group of a finer level that clusters were simplified from.
struct LevelRefinement {
    GroupPlace place;
    Sphere bounds;             // local space
    double error = 0;          // world units
    double attributeError = 0; // world units

    double drawnError() const { return std::max(error, attributeError); }
};

/// A vertex of the mesh that lies, from a level on, where `at` lies.
struct MovedVertex {
    std::uint32_t vertex = 0;
    std::uint32_t at = 0;
};

struct LevelCluster {
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
    std::uint32_t vertexCount = 0;
    std::uint32_t refinement = hierarchy::kNone; // of the level's refinements: the group that it was simplified from
    hierarchy::GridBox box;
};

struct LevelGroup {
    std::uint32_t firstCluster = 0;
    std::uint32_t clusterCount = 0;
    hierarchy::GridBox box;
    Sphere bounds;             // local space
    double error = kNoLimit;   // world units; infinite for a root
    double attributeError = 0; // world units; 0 for a root
    GroupPlace place;
    bool isDeferred = false; // its clusters go on to the next level as they are
};

/// Clusters of a group and triangles of a cluster are contiguous.
struct Level {
    std::vector<simplify::Triangle> triangles;   // vertices of the Mesh
    std::vector<simplify::TriangleError> errors; // per triangle
    std::vector<LevelCluster> clusters;
    std::vector<LevelGroup> groups;
    std::vector<LevelRefinement> refinements;
    std::vector<MovedVertex> moved;         // vertices of the mesh that change their position from this level on
    std::vector<TransferredNormal> normals; // that vertices of the mesh take from this level on
    std::vector<TransferredWord> colors;    // likewise
    std::vector<TransferredWord> fields;    // likewise
};

} // namespace gnomon::levels
