#include "preprocess/levels/level.h"

#include "preprocess/levels/cluster.h"
#include "preprocess/levels/group_patch.h"
#include "preprocess/levels/kd_split.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace gnomon::levels {

namespace {

using hierarchy::kNone;

constexpr std::uint32_t kGroupClusters = 16;
constexpr double kToleranceShare = 0.25; // of the error that the clusters of a group already have

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

/// Appends the clusters of `triangles`, which lie there in the order of `clustering`, to `level`.
void appendClusters(
    const simplify::Mesh& mesh,
    std::span<const simplify::Triangle> triangles,
    const Clustering& clustering,
    Level& level) {
    std::uint32_t begin = 0;
    for (std::size_t c = 0; c < clustering.ends.size(); ++c) {
        LevelCluster cluster;
        cluster.firstTriangle = begin;
        cluster.triangleCount = clustering.ends[c] - begin;
        cluster.vertexCount = clustering.vertexCounts[c];
        for (const simplify::Triangle& t : triangles.subspan(begin, cluster.triangleCount))
            for (const std::uint32_t v : t)
                cluster.box.add(mesh.vertices[v].position);
        level.clusters.push_back(cluster);
        begin = clustering.ends[c];
    }
}

std::uint64_t triangleCount(const Level& level, const LevelGroup& group) {
    const LevelCluster& first = level.clusters[group.firstCluster];
    const LevelCluster& last = level.clusters[group.firstCluster + group.clusterCount - 1];
    return last.firstTriangle + last.triangleCount - first.firstTriangle;
}

/// What a group becomes.
struct GroupResult {
    Level clusters; // firstTriangle counts from the group's own first triangle
    double error = 0;
};

double worstRefinement(const Level& level, const LevelGroup& group) {
    double worst = 0;
    for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
        if (const std::uint32_t refinement = level.clusters[c].refinement; refinement != kNone)
            worst = std::max(worst, level.refinements[refinement].error);
    return worst;
}

class GroupSimplifier {
public:
    GroupSimplifier(const simplify::Mesh& mesh, const Level& level, const LevelOptions& options, Price price)
        : mesh_(mesh), level_(level), options_(options), price_(price), owners_(mesh, level) {}

    GroupResult operator()(std::uint32_t groupIndex, PatchNumbers& numbers) const {
        const LevelGroup& group = level_.groups[groupIndex];
        const LevelCluster& first = level_.clusters[group.firstCluster];
        const std::size_t count = triangleCount(level_, group);
        const auto triangles = std::span(level_.triangles).subspan(first.firstTriangle, count);
        GroupPatch patch = makeGroupPatch(mesh_, triangles, owners_, numbers);
        patch.patch.isAnyPrice = price_ == Price::Any;
        patch.patch.isBounded = options_.isErrorMeasured;
        patch.patch.errors = std::span(level_.errors).subspan(first.firstTriangle, count);
        const simplify::SimplifiedPatch simplified =
            simplify::simplify(patch.patch, (count + 1) / 2, options_.simplifier);
        const double before = std::max(worstRefinement(level_, group), mesh_.grid.snapError());
        GroupResult result;
        std::vector<simplify::TriangleError> errors(simplified.triangles.size());
        if (options_.isErrorMeasured) {
            if (simplified.errors.empty()) {
                const double tolerance = before / mesh_.grid.step() * kToleranceShare;
                errors = simplify::measureDeviation(patch.patch, simplified, tolerance).errors;
            } else {
                errors = simplified.errors;
            }
            double worst = 0;
            for (const simplify::TriangleError& error : errors)
                worst = std::max({worst, double{error.fromSource}, double{error.toSource}});
            // A little more than computed: the distances themselves are rounded.
            const double measured = worst * (1 + 1e-9) * mesh_.grid.step() + mesh_.grid.snapError();
            result.error = std::max(before, measured);
        } else {
            result.error = before + simplified.claimedError * mesh_.grid.step();
        }
        cutIntoClusters(patch, simplified, errors, groupIndex, result.clusters);
        result.clusters.normals = carriedNormals(patch.patch, simplified);
        for (CarriedNormal& carried : result.clusters.normals)
            carried.vertex = patch.globalVertex[carried.vertex];
        return result;
    }

private:
    void cutIntoClusters(
        const GroupPatch& patch,
        const simplify::SimplifiedPatch& simplified,
        const std::vector<simplify::TriangleError>& errors,
        std::uint32_t groupIndex,
        Level& out) const {
        std::vector<glm::vec3> positions;
        positions.reserve(patch.patch.positions.size());
        for (const glm::dvec3& p : patch.patch.positions)
            positions.emplace_back(p);
        const Clustering clustering =
            clusterTriangles(simplified.triangles, patch.patch.positionOf, positions, options_.clusterTriangles);
        for (const std::uint32_t t : clustering.order) {
            const simplify::Triangle& local = simplified.triangles[t];
            out.triangles.push_back(
                {patch.globalVertex[local[0]], patch.globalVertex[local[1]], patch.globalVertex[local[2]]});
            out.errors.push_back(errors[t]);
        }
        appendClusters(mesh_, out.triangles, clustering, out);
        for (LevelCluster& cluster : out.clusters)
            cluster.refinement = groupIndex;
    }

    const simplify::Mesh& mesh_;
    const Level& level_;
    const LevelOptions& options_;
    Price price_;
    PositionOwners owners_;
};

} // namespace

Level firstLevel(const simplify::Mesh& mesh, const LevelOptions& options) {
    std::vector<glm::vec3> positions(mesh.positionCount);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        positions[mesh.positionOf[v]] = toVector(mesh.vertices[v].position);
    const Clustering clustering =
        clusterTriangles(mesh.triangles, mesh.positionOf, positions, options.clusterTriangles);
    Level level;
    level.triangles.reserve(mesh.triangles.size());
    for (const std::uint32_t t : clustering.order)
        level.triangles.push_back(mesh.triangles[t]);
    level.errors.assign(level.triangles.size(), {});
    appendClusters(mesh, level.triangles, clustering, level);
    return level;
}

void formGroups(Level& level, const hierarchy::Grid& grid, const LevelOptions& options, std::uint32_t number) {
    std::vector<KdItem> items;
    items.reserve(level.clusters.size());
    for (std::uint32_t c = 0; c < level.clusters.size(); ++c)
        items.push_back({centerOf(level.clusters[c].box), level.clusters[c].triangleCount, c});
    const std::uint64_t maxWeight = std::uint64_t{kGroupClusters} * options.clusterTriangles;
    const KdParts parts = kdSplit(items, maxWeight, kGroupCutFractions.at(number % kGroupCutFractions.size()));
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
            if (cluster.refinement != kNone) children.push_back(level.refinements[cluster.refinement].bounds);
            ordered.clusters.push_back(cluster);
        }
        group.bounds = enclosing(grid.local(group.box), children);
        ordered.groups.push_back(group);
        begin = end;
    }
    ordered.refinements = std::move(level.refinements);
    level = std::move(ordered);
}

Level simplifiedLevel(
    const simplify::Mesh& mesh, Level& level, const LevelOptions& options, Price price, Progress& progress) {
    const GroupSimplifier simplifier(mesh, level, options, price);
    std::vector<GroupResult> results(level.groups.size());
    tbb::enumerable_thread_specific<PatchNumbers> numbers([&] { return PatchNumbers(mesh); });
    tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t g) {
        results[g] = simplifier(static_cast<std::uint32_t>(g), numbers.local());
        progress.advance(triangleCount(level, level.groups[g]));
    });
    Level next;
    for (std::size_t g = 0; g < results.size(); ++g) {
        LevelGroup& group = level.groups[g];
        group.error = results[g].error;
        next.refinements.push_back({group.place, group.bounds, group.error});
        const auto first = static_cast<std::uint32_t>(next.triangles.size());
        const Level& own = results[g].clusters;
        next.triangles.insert(next.triangles.end(), own.triangles.begin(), own.triangles.end());
        next.errors.insert(next.errors.end(), own.errors.begin(), own.errors.end());
        next.normals.insert(next.normals.end(), own.normals.begin(), own.normals.end());
        for (LevelCluster cluster : own.clusters) {
            cluster.firstTriangle += first;
            next.clusters.push_back(cluster);
        }
    }
    return next;
}

} // namespace gnomon::levels
