#include "preprocess/levels/node.h"

#include "preprocess/levels/grouping.h"
#include "preprocess/levels/level_simplification.h"

namespace gnomon::levels {

namespace {

using hierarchy::kNone;

// Only levels below this number may defer clusters to the next level, so that the hierarchy reaches its root within
// kMaxLevels levels.
constexpr std::uint32_t kDeferringLevels = hierarchy::kMaxLevels / 2;
constexpr double kMinProgress = 0.95; // max share of a level's triangles in a useful next level

hierarchy::LevelInfo infoOf(const Level& level, const hierarchy::Grid& grid) {
    hierarchy::LevelInfo info;
    info.triangles = level.triangles.size();
    info.clusters = level.clusters.size();
    info.groups = level.groups.size();
    info.maxError = grid.snapError();
    for (const LevelCluster& cluster : level.clusters) {
        if (cluster.refinement == kNone) continue;
        const LevelRefinement& finer = level.refinements[cluster.refinement];
        info.maxError = std::max(info.maxError, finer.error);
        info.maxAttributeError = std::max(info.maxAttributeError, finer.attributeError);
    }
    return info;
}

bool isWorthwhile(const Level& next, std::uint64_t triangles) {
    return !next.triangles.empty() &&
           static_cast<double>(next.triangles.size()) <= kMinProgress * static_cast<double>(triangles);
}

/// The next coarser level, and whether it has sufficiently fewer triangles.
struct Coarser {
    Level level;
    bool isWorthwhile = false;
};

/// Returns the next coarser level. The function forms the groups of `level` and simplifies them with a cost limit.
/// `number` is the index of the level. If the result has too many triangles and `isToRoot` is true, the function
/// repeats the simplification without a limit. Level 0 does not defer clusters, because each cluster of a higher level
/// must refer to a finer group. High levels do not defer clusters either, so that enough levels remain to reach the
/// root.
Coarser coarserLevel(
    const simplify::Mesh& mesh,
    Level& level,
    std::uint32_t number,
    bool isToRoot,
    const LevelOptions& options,
    Progress& progress) {
    const auto make = [&](simplify::CostLimit limit, bool mayDefer) {
        formGroups(level, mesh.grid, options, number, mayDefer);
        Coarser coarser = {simplifiedLevel(mesh, level, options, limit, mayDefer, progress)};
        coarser.isWorthwhile = isWorthwhile(coarser.level, level.triangles.size());
        return coarser;
    };
    Coarser limited = make(simplify::CostLimit::MeanEdge, number > 0 && number < kDeferringLevels);
    if (limited.isWorthwhile || !isToRoot) return limited;
    return make(simplify::CostLimit::None, false);
}

/// Sets infinite errors on the groups of the root level, because no coarser cluster replaces their clusters.
void endAtRoot(Level& level) {
    for (LevelGroup& group : level.groups) {
        group.error = kNoLimit;
        group.attributeError = 0;
    }
}

/// Copies the page locations of the groups of `level` to the refinements of `next` that were simplified from these
/// groups.
void tellPlaces(const Level& level, Level& next) {
    for (std::size_t g = 0; g < level.groups.size(); ++g)
        next.refinements[g].place = level.groups[g].place;
}

void takeVertices(const Level& level, simplify::Mesh& mesh) {
    for (const MovedVertex& moved : level.moved) {
        mesh.vertices[moved.vertex].position = mesh.vertices[moved.at].position;
        mesh.positionOf[moved.vertex] = mesh.positionOf[moved.at];
    }
    for (const TransferredWord& carried : level.colors)
        mesh.vertices[carried.vertex].color = carried.word;
    for (const TransferredWord& carried : level.fields)
        mesh.fields.words[carried.vertex] = carried.word;
    for (const TransferredNormal& carried : level.normals)
        mesh.vertices[carried.vertex].normal = carried.normal;
}

} // namespace

BuiltNode buildNode(
    simplify::Mesh& mesh, Level level, const NodePlan& plan, const LevelOptions& options, Progress& progress) {
    BuiltNode node;
    if (level.triangles.empty()) return node;
    const bool isToRoot = plan.levelCount == kNone;
    const auto keep = [&](std::uint32_t number) {
        const std::uint32_t pageCount = placeGroups(level, number);
        node.levels.push_back({infoOf(level, mesh.grid), encodePages(mesh, level, number, pageCount)});
    };
    for (std::uint32_t number = plan.firstLevel; isToRoot || number - plan.firstLevel < plan.levelCount; ++number) {
        const bool isSingle = level.clusters.size() == 1;
        if (isSingle && !isToRoot && number > 0) break;
        Coarser coarser;
        if (!isSingle || !isToRoot)
            coarser = coarserLevel(mesh, level, number, isToRoot, options, progress);
        else
            formGroups(level, mesh.grid, options, number, false);
        if (!coarser.isWorthwhile && isToRoot) {
            endAtRoot(level);
            keep(number);
            node.rootTriangles = level.triangles.size();
            if (number == 0 && !isSingle) node.irreducibleTriangles = level.triangles.size();
            return node;
        }
        if (!coarser.isWorthwhile && number > 0) break;
        dropDeferred(level);
        keep(number);
        tellPlaces(level, coarser.level);
        level = std::move(coarser.level);
        takeVertices(level, mesh);
    }
    node.pending = encodeOpenClusters(mesh, level);
    return node;
}

} // namespace gnomon::levels
