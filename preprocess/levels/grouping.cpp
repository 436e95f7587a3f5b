#include "preprocess/levels/grouping.h"

#include "preprocess/levels/kd_split.h"

#include <algorithm>
#include <array>
#include <span>

namespace gnomon::levels {

namespace {

constexpr std::uint32_t kGroupClusters = 16;

/// Where each level's cuts lie: never twice in a row in the same place.
constexpr std::array<double, 3> kGroupCutFractions{0.5, 0.42, 0.58};

glm::vec3 toVector(const hierarchy::GridPoint& p) {
    return glm::dvec3(p.x, p.y, p.z);
}

glm::vec3 centerOf(const hierarchy::GridBox& box) {
    return (toVector(box.min) + toVector(box.max)) * 0.5F;
}

/// A ball around the middle of `box` that holds its corners and the `children`, a hair larger than computed so that
/// rounding cannot undo it.
Sphere enclosing(const Box& box, std::span<const Sphere> children) {
    Sphere sphere{box.center(), glm::length(box.extent()) * 0.5};
    for (const Sphere& child : children)
        sphere.radius = std::max(sphere.radius, glm::length(child.center - sphere.center) + child.radius);
    sphere.radius *= 1 + 0x1p-40;
    return sphere;
}

} // namespace

void formGroups(Level& level, const hierarchy::Grid& grid, const LevelOptions& options, std::uint32_t number) {
    std::vector<KdItem> items;
    items.reserve(level.clusters.size());
    for (std::uint32_t c = 0; c < level.clusters.size(); ++c)
        items.push_back({centerOf(level.clusters[c].box), level.clusters[c].triangleCount, c});
    const std::uint64_t maxWeight = std::uint64_t{kGroupClusters} * options.clusterTriangles;
    // Half a group at least on either side of a gap: small parts need others near them to merge with.
    const KdParts parts =
        kdSplit(items, maxWeight, kGroupCutFractions.at(number % kGroupCutFractions.size()), maxWeight / 2);
    Level ordered;
    ordered.triangles.reserve(level.triangles.size());
    ordered.errors.reserve(level.errors.size());
    std::uint32_t begin = 0;
    std::vector<Sphere> children;
    for (const std::uint32_t end : parts.ends) {
        LevelGroup group;
        group.firstCluster = begin;
        group.clusterCount = end - begin;
        children.clear();
        for (std::uint32_t i = begin; i < end; ++i) {
            LevelCluster cluster = level.clusters[parts.order[i]];
            const auto first = static_cast<std::ptrdiff_t>(cluster.firstTriangle);
            const auto last = first + static_cast<std::ptrdiff_t>(cluster.triangleCount);
            cluster.firstTriangle = static_cast<std::uint32_t>(ordered.triangles.size());
            ordered.triangles.insert(
                ordered.triangles.end(), level.triangles.begin() + first, level.triangles.begin() + last);
            ordered.errors.insert(ordered.errors.end(), level.errors.begin() + first, level.errors.begin() + last);
            group.box.add(cluster.box);
            if (cluster.refinement != hierarchy::kNone)
                children.push_back(level.refinements[cluster.refinement].bounds);
            ordered.clusters.push_back(cluster);
        }
        group.bounds = enclosing(grid.local(group.box), children);
        ordered.groups.push_back(group);
        begin = end;
    }
    ordered.refinements = std::move(level.refinements);
    level = std::move(ordered);
}

} // namespace gnomon::levels
