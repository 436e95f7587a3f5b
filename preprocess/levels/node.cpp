#include "preprocess/levels/node.h"

namespace gnomon::levels {

namespace {

using hierarchy::kNone;

constexpr double kLeastProgress = 0.95; // a level of more than this share of the one below is not worth having

hierarchy::LevelInfo infoOf(const Level& level, const hierarchy::Grid& grid) {
    hierarchy::LevelInfo info;
    info.triangles = level.triangles.size();
    info.clusters = level.clusters.size();
    info.groups = level.groups.size();
    info.maxError = grid.snapError();
    for (const LevelCluster& cluster : level.clusters)
        if (cluster.refinement != kNone)
            info.maxError = std::max(info.maxError, level.refinements[cluster.refinement].error);
    return info;
}

bool isWorthwhile(const Level& next, std::uint64_t triangles) {
    return !next.triangles.empty() &&
           static_cast<double>(next.triangles.size()) <= kLeastProgress * static_cast<double>(triangles);
}

/// What simplification makes of a level, and whether that is worth having.
struct Coarser {
    Level level;
    bool isWorthwhile = false;
};

/// On the way to the root, what cannot be had at a fair price is had at any.
Coarser coarserLevel(
    const simplify::Mesh& mesh, Level& level, bool isToRoot, const LevelOptions& options, Progress& progress) {
    const auto at = [&](Price price) {
        Coarser coarser = {simplifiedLevel(mesh, level, options, price, progress)};
        coarser.isWorthwhile = isWorthwhile(coarser.level, level.triangles.size());
        return coarser;
    };
    Coarser fair = at(Price::Fair);
    if (fair.isWorthwhile || !isToRoot) return fair;
    return at(Price::Any);
}

/// The groups of a root: nothing coarser stands in for them, whatever the error.
void endAtRoot(Level& level) {
    for (LevelGroup& group : level.groups)
        group.error = std::numeric_limits<double>::infinity();
}

void takeNormals(const Level& level, simplify::Mesh& mesh) {
    for (const CarriedNormal& carried : level.normals)
        mesh.vertices[carried.vertex].normal = carried.normal;
}

} // namespace

BuiltNode buildNode(
    simplify::Mesh& mesh, Level level, const NodePlan& plan, const LevelOptions& options, Progress& progress) {
    BuiltNode node;
    if (level.triangles.empty()) return node;
    const bool isToRoot = plan.levelCount == kNone;
    const auto keep = [&](std::uint32_t number, std::uint32_t pageCount) {
        node.levels.push_back({infoOf(level, mesh.grid), encodePages(mesh, level, number, pageCount)});
    };
    for (std::uint32_t number = plan.firstLevel; isToRoot || number - plan.firstLevel < plan.levelCount; ++number) {
        const bool isSingle = level.clusters.size() == 1;
        if (isSingle && !isToRoot && number > 0) break;
        formGroups(level, mesh.grid, options, number);
        const std::uint32_t pageCount = placeGroups(level, number);
        Coarser coarser;
        if (!isSingle || !isToRoot) coarser = coarserLevel(mesh, level, isToRoot, options, progress);
        if (!coarser.isWorthwhile && isToRoot) {
            endAtRoot(level);
            keep(number, pageCount);
            node.rootTriangles = level.triangles.size();
            if (number == 0 && !isSingle) node.stuckTriangles = level.triangles.size();
            return node;
        }
        if (!coarser.isWorthwhile && number > 0) break;
        keep(number, pageCount);
        level = std::move(coarser.level);
        takeNormals(level, mesh);
    }
    node.remains = encodeRemains(mesh, level);
    return node;
}

} // namespace gnomon::levels
