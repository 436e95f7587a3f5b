#include "preprocess/levels/grouping.h"

#include "preprocess/levels/kd_split.h"

#include <algorithm>
#include <array>
#include <span>

namespace gnomon::levels {

namespace {

constexpr std::uint32_t kGroupClusters = 16;

/// The share of the weight on the low side of each kd-tree cut that forms groups, indexed by the level modulo 3. The
/// shares differ so that consecutive levels are divided at different places.
constexpr std::array<double, 3> kGroupCutFractions{0.5, 0.42, 0.58};

// The usual error of a level is the error that this share of its triangles does not exceed. Clusters with up to
// kMaxUsualRatio times this error are grouped, and other clusters may be deferred to the next level.
constexpr double kUsualShare = 2.0 / 3;
constexpr double kMaxUsualRatio = 2;

glm::vec3 toVector(const hierarchy::GridPoint& p) {
    return glm::dvec3(p.x, p.y, p.z);
}

glm::vec3 centerOf(const hierarchy::GridBox& box) {
    return (toVector(box.min) + toVector(box.max)) * 0.5F;
}

/// Returns a sphere around the centre of `box` that contains the corners of the box and the spheres `children`. The
/// radius is slightly enlarged to cover rounding errors.
Sphere enclosing(const Box& box, std::span<const Sphere> children) {
    Sphere sphere{box.center(), glm::length(box.extent()) * 0.5};
    for (const Sphere& child : children)
        sphere.radius = std::max(sphere.radius, glm::length(child.center - sphere.center) + child.radius);
    sphere.radius *= 1 + 0x1p-40;
    return sphere;
}

/// Returns the max error in world units for which a cluster of `level` is grouped. Clusters with a larger error are
/// deferred to the next level.
double greatestGroupedError(const Level& level) {
    std::vector<WeightedError> errors;
    for (const LevelCluster& cluster : level.clusters)
        errors.push_back({level.refinements[cluster.refinement].drawnError(), cluster.triangleCount});
    return kMaxUsualRatio * errorQuantile(std::move(errors), kUsualShare);
}

/// Appends `cluster` and its triangles to the level `to`. The cluster belongs to the level `from`.
void append(const Level& from, LevelCluster cluster, Level& to) {
    const auto first = static_cast<std::ptrdiff_t>(cluster.firstTriangle);
    const auto last = first + static_cast<std::ptrdiff_t>(cluster.triangleCount);
    cluster.firstTriangle = static_cast<std::uint32_t>(to.triangles.size());
    to.triangles.insert(to.triangles.end(), from.triangles.begin() + first, from.triangles.begin() + last);
    to.errors.insert(to.errors.end(), from.errors.begin() + first, from.errors.begin() + last);
    to.clusters.push_back(cluster);
}

std::span<const LevelCluster> clustersOf(const Level& level, const LevelGroup& group) {
    return std::span(level.clusters).subspan(group.firstCluster, group.clusterCount);
}

} // namespace

double errorQuantile(std::vector<WeightedError> errors, double share) {
    std::uint64_t all = 0;
    for (const WeightedError& error : errors)
        all += error.triangles;
    std::ranges::sort(errors, {}, &WeightedError::error);
    std::uint64_t sum = 0;
    for (const WeightedError& error : errors) {
        sum += error.triangles;
        if (static_cast<double>(sum) >= share * static_cast<double>(all)) return error.error;
    }
    return kNoLimit;
}

void formGroups(
    Level& level, const hierarchy::Grid& grid, const LevelOptions& options, std::uint32_t number, bool mayDefer) {
    const double greatest = mayDefer ? greatestGroupedError(level) : kNoLimit;
    std::vector<KdItem> items;
    items.reserve(level.clusters.size());
    std::vector<std::uint32_t> deferred;
    for (std::uint32_t c = 0; c < level.clusters.size(); ++c) {
        const LevelCluster& cluster = level.clusters[c];
        if (!mayDefer || level.refinements[cluster.refinement].drawnError() <= greatest)
            items.push_back({centerOf(cluster.box), cluster.triangleCount, c});
        else
            deferred.push_back(c);
    }
    const std::uint64_t maxWeight = std::uint64_t{kGroupClusters} * options.clusterTriangles;
    // The kd-tree cuts in a gap only if each side has at least half the triangles of a group, because small parts need
    // neighbours to merge with.
    KdParts parts = kdSplit(items, maxWeight, kGroupCutFractions.at(number % kGroupCutFractions.size()), maxWeight / 2);
    const std::size_t formed = parts.ends.size();
    for (const std::uint32_t c : deferred) {
        parts.order.push_back(c);
        parts.ends.push_back(static_cast<std::uint32_t>(parts.order.size()));
    }
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
        group.isDeferred = ordered.groups.size() >= formed;
        group.bounds = enclosing(grid.local(group.box), children);
        ordered.groups.push_back(group);
        begin = end;
    }
    ordered.refinements = std::move(level.refinements);
    level = std::move(ordered);
}

void dropDeferred(Level& level) {
    if (std::ranges::none_of(level.groups, &LevelGroup::isDeferred)) return;
    Level rest;
    for (LevelGroup group : level.groups) {
        if (group.isDeferred) continue;
        const auto first = static_cast<std::uint32_t>(rest.clusters.size());
        for (const LevelCluster& cluster : clustersOf(level, group))
            append(level, cluster, rest);
        group.firstCluster = first;
        rest.groups.push_back(group);
    }
    rest.refinements = std::move(level.refinements);
    level = std::move(rest);
}

void appendDeferred(const Level& level, Level& next) {
    // For each refinement of `level`, its index in `next`.
    std::vector<std::uint32_t> numbers(level.refinements.size(), hierarchy::kNone);
    for (const LevelGroup& group : level.groups) {
        if (!group.isDeferred) continue;
        for (const LevelCluster& cluster : clustersOf(level, group)) {
            append(level, cluster, next);
            std::uint32_t& number = numbers[cluster.refinement];
            if (number == hierarchy::kNone) {
                number = static_cast<std::uint32_t>(next.refinements.size());
                next.refinements.push_back(level.refinements[cluster.refinement]);
            }
            next.clusters.back().refinement = number;
        }
    }
}

} // namespace gnomon::levels
