// One level of detail while it is built: clusters, groups of them, and the step to the next coarser level.
#pragma once

#include "core/progress.h"
#include "preprocess/levels/carried_normals.h"
#include "preprocess/simplify/deviation.h"
#include "preprocess/simplify/mesh.h"
#include "preprocess/simplify/simplify.h"

#include <limits>

namespace gnomon::levels {

/// What shapes the hierarchy; part of what a .gnm says about itself.
struct LevelOptions {
    std::uint32_t clusterTriangles = 128;
    simplify::Simplifier simplifier = simplify::Simplifier::Own;
    bool isErrorMeasured = true;
};

/// Where a group lies: its level, its page within that level's pages, its place in the page.
struct GroupPlace {
    std::uint32_t level = 0;
    std::uint32_t page = 0;
    std::uint32_t group = 0;
};

/// A group of a finer level that clusters were simplified from.
struct LevelRefinement {
    GroupPlace place;
    Sphere bounds;    // local space
    double error = 0; // world units
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
    Sphere bounds;                                          // local space
    double error = std::numeric_limits<double>::infinity(); // world units; infinite for a root
    GroupPlace place;
};

/// Clusters of a group and triangles of a cluster are contiguous.
struct Level {
    std::vector<simplify::Triangle> triangles;   // vertices of the Mesh
    std::vector<simplify::TriangleError> errors; // per triangle
    std::vector<LevelCluster> clusters;
    std::vector<LevelGroup> groups;
    std::vector<LevelRefinement> refinements;
    std::vector<CarriedNormal> normals; // that vertices of the mesh take from this level on
};

/// Level 0: the mesh's triangles in clusters, without groups.
Level firstLevel(const simplify::Mesh& mesh, const LevelOptions& options);

/// Forms the groups of `level`, the `number`th from 0, and reorders clusters and triangles accordingly. Cuts lie
/// elsewhere than in the level before, so that the borders which were locked there become interiors here.
void formGroups(Level& level, const hierarchy::Grid& grid, const LevelOptions& options, std::uint32_t number);

/// What a collapse may cost: no more than what it removes is long, or anything. Where only borders that other groups
/// count on are left to collapse, a fair price means to wait for the next level, whose borders lie elsewhere.
enum class Price { Fair, Any };

/// Simplifies each group of `level` to half, as far as `price` allows, sets the groups' errors, and returns the
/// clusters that replace them, not yet in groups. Each group is a pure function of its own triangles and of which
/// positions it shares with others. Advances `progress` by the level's triangles.
Level simplifiedLevel(
    const simplify::Mesh& mesh, Level& level, const LevelOptions& options, Price price, Progress& progress);

} // namespace gnomon::levels
