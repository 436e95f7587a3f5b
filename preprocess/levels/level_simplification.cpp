#include "preprocess/levels/level_simplification.h"

#include "preprocess/levels/group_patch.h"
#include "preprocess/levels/grouping.h"
#include "preprocess/levels/level_clusters.h"
#include "preprocess/simplify/hausdorff_bound.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>

namespace gnomon::levels {

namespace {

using hierarchy::kNone;

// Max error of a group, as a multiple of the level's median error. Groups with a larger error are deferred to the next
// level.
constexpr double kMaxMedianRatio = 4;
constexpr double kToleranceShare = 0.25; // max error that the measurement may add, as a share of the existing error
constexpr double kTightShare = 0.5;      // the measurement stops below this share of the collapse bound

std::uint64_t triangleCount(const Level& level, const LevelGroup& group) {
    const LevelCluster& first = level.clusters[group.firstCluster];
    const LevelCluster& last = level.clusters[group.firstCluster + group.clusterCount - 1];
    return last.firstTriangle + last.triangleCount - first.firstTriangle;
}

/// The simplified clusters of one group and their error.
struct GroupResult {
    Level clusters; // `firstTriangle` counts from the first triangle of the group
    double error = 0;
    double attributeError = 0;
    double before = 0; // max error of the group's clusters before the simplification (geometry and attributes)

    double drawnError() const { return std::max(error, attributeError); }

    /// Returns true if the error of the simplified group is at most `greatest`, or not larger than the error before the
    /// simplification.
    bool isWithin(double greatest) const { return drawnError() <= std::max(greatest, before); }
};

double largestOf(std::span<const simplify::TriangleError> errors) {
    double worst = 0;
    for (const simplify::TriangleError& error : errors)
        worst = std::max({worst, double{error.fromSource}, double{error.toSource}});
    return worst;
}

/// Returns the error bounds of the triangles of `simplified`, by measurement against `patch`. If the max of the
/// measured bounds is not lower than that of the simplifier's bounds, returns the simplifier's bounds. These are sums
/// over all collapses. They are often too large, because one collapse can undo the displacement of another.
std::vector<simplify::TriangleError> tightErrors(
    const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified) {
    const double worst = largestOf(simplified.errors);
    simplify::HausdorffBound measured =
        simplify::measureHausdorffBound(patch, simplified, std::max(largestOf(patch.errors), kTightShare * worst));
    if (measured.worst < worst) return std::move(measured.errors);
    return simplified.errors;
}

/// Returns the max error of the finer groups from which a group's clusters were simplified. `error` selects the member:
/// geometric error or error of attributes.
double worstRefinement(const Level& level, const LevelGroup& group, double LevelRefinement::*error) {
    double worst = 0;
    for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
        if (const std::uint32_t refinement = level.clusters[c].refinement; refinement != kNone)
            worst = std::max(worst, level.refinements[refinement].*error);
    return worst;
}

class GroupSimplifier {
public:
    GroupSimplifier(
        const simplify::Mesh& mesh, const Level& level, const LevelOptions& options, simplify::CostLimit limit)
        : mesh_(mesh), level_(level), options_(options), costLimit_(limit), owners_(mesh, level) {}

    GroupResult operator()(std::uint32_t groupIndex, PatchNumbers& numbers) const {
        const LevelGroup& group = level_.groups[groupIndex];
        const LevelCluster& first = level_.clusters[group.firstCluster];
        const std::size_t count = triangleCount(level_, group);
        const auto triangles = std::span(level_.triangles).subspan(first.firstTriangle, count);
        GroupPatch patch = makeGroupPatch(mesh_, triangles, owners_, numbers);
        patch.patch.costLimit = costLimit_;
        patch.patch.isErrorBounded = options_.error != ErrorKind::Estimated;
        patch.patch.errors = std::span(level_.errors).subspan(first.firstTriangle, count);
        const simplify::SimplifiedPatch simplified =
            simplify::simplify(patch.patch, (count + 1) / 2, options_.simplifier);
        GroupResult result;
        const double before = std::max(worstRefinement(level_, group, &LevelRefinement::error), mesh_.grid.snapError());
        const double attributesBefore = worstRefinement(level_, group, &LevelRefinement::attributeError);
        result.before = std::max(before, attributesBefore);
        std::vector<simplify::TriangleError> errors(simplified.triangles.size());
        if (options_.error == ErrorKind::Estimated) {
            result.error = before + simplified.estimatedError * mesh_.grid.step();
        } else {
            errors = boundedErrors(patch.patch, simplified, before);
            // The error is slightly enlarged, because the computed distances are rounded.
            const double measured = largestOf(errors) * (1 + 1e-9) * mesh_.grid.step() + mesh_.grid.snapError();
            result.error = std::max(before, measured);
        }
        cutIntoClusters(patch, simplified, errors, result.clusters);
        transferAttributes(patch, simplified, result);
        result.attributeError = std::max(result.attributeError, attributesBefore);
        return result;
    }

private:
    /// Returns the error bounds of each triangle of a simplified patch. `before` is the error of the group's clusters
    /// before the simplification, in world units.
    std::vector<simplify::TriangleError> boundedErrors(
        const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified, double before) const {
        if (simplified.errors.empty()) {
            const double goal = before / mesh_.grid.step() * (1 + kToleranceShare);
            return simplify::measureHausdorffBound(patch, simplified, goal).errors;
        }
        return options_.error == ErrorKind::Tight ? tightErrors(patch, simplified) : simplified.errors;
    }

    void transferAttributes(
        const GroupPatch& patch, const simplify::SimplifiedPatch& simplified, GroupResult& result) const {
        result.clusters.normals = transferredNormals(patch.patch, simplified);
        for (TransferredNormal& normal : result.clusters.normals)
            normal.vertex = patch.globalVertex[normal.vertex];
        ColorTransfer colors = transferredColors(patch.patch, simplified);
        result.clusters.colors = std::move(colors.colors);
        result.clusters.fields = transferredFields(patch.patch, simplified);
        for (std::vector<TransferredWord>* words : {&result.clusters.colors, &result.clusters.fields})
            for (TransferredWord& word : *words)
                word.vertex = patch.globalVertex[word.vertex];
        result.attributeError = colors.error * mesh_.grid.step();
    }

    /// Divides the simplified triangles of a group into clusters, appends them to `out`, and records the moved
    /// vertices.
    void cutIntoClusters(
        const GroupPatch& patch,
        const simplify::SimplifiedPatch& simplified,
        const std::vector<simplify::TriangleError>& errors,
        Level& out) const {
        std::vector<glm::vec3> positions;
        positions.reserve(patch.patch.positions.size());
        for (const glm::dvec3& p : patch.patch.positions)
            positions.emplace_back(p);
        const auto count = static_cast<std::uint32_t>(patch.patch.vertices.size());
        std::vector<std::uint32_t> vertexAt(positions.size()); // per position before the move: a mesh vertex at it
        std::vector<std::uint32_t> positionOf(count);
        for (std::uint32_t v = 0; v < count; ++v) {
            vertexAt[patch.patch.positionOf[v]] = patch.globalVertex[v];
            positionOf[v] = simplified.positionOf(patch.patch, v);
        }
        const Clustering clustering =
            clusterTriangles(simplified.triangles, positionOf, positions, options_.clusterTriangles);
        std::vector<simplify::Triangle> places;
        places.reserve(clustering.order.size());
        std::vector<bool> isMoved(count);
        for (const std::uint32_t t : clustering.order) {
            const simplify::Triangle& local = simplified.triangles[t];
            out.triangles.push_back(
                {patch.globalVertex[local[0]], patch.globalVertex[local[1]], patch.globalVertex[local[2]]});
            out.errors.push_back(errors[t]);
            places.push_back(
                {vertexAt[positionOf[local[0]]], vertexAt[positionOf[local[1]]], vertexAt[positionOf[local[2]]]});
            for (const std::uint32_t v : local) {
                if (positionOf[v] == patch.patch.positionOf[v] || isMoved[v]) continue;
                isMoved[v] = true;
                out.moved.push_back({patch.globalVertex[v], vertexAt[positionOf[v]]});
            }
        }
        appendClusters(mesh_, places, clustering, out);
    }

    const simplify::Mesh& mesh_;
    const Level& level_;
    const LevelOptions& options_;
    simplify::CostLimit costLimit_;
    PositionOwners owners_;
};

/// Defers groups to the next level if their error is more than kMaxMedianRatio times the median error of the level.
void deferExpensiveGroups(Level& level, const std::vector<GroupResult>& results) {
    std::vector<WeightedError> errors;
    for (std::size_t g = 0; g < results.size(); ++g)
        if (!level.groups[g].isDeferred)
            errors.push_back({results[g].drawnError(), triangleCount(level, level.groups[g])});
    const double greatest = kMaxMedianRatio * errorQuantile(std::move(errors), 0.5);
    for (std::size_t g = 0; g < results.size(); ++g)
        if (!results[g].isWithin(greatest)) level.groups[g].isDeferred = true;
}

} // namespace

Level simplifiedLevel(
    const simplify::Mesh& mesh,
    Level& level,
    const LevelOptions& options,
    simplify::CostLimit limit,
    bool mayDefer,
    Progress& progress) {
    const GroupSimplifier simplifier(mesh, level, options, limit);
    std::vector<GroupResult> results(level.groups.size());
    tbb::enumerable_thread_specific<PatchNumbers> numbers([&] { return PatchNumbers(mesh); });
    tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t g) {
        if (!level.groups[g].isDeferred) results[g] = simplifier(static_cast<std::uint32_t>(g), numbers.local());
        progress.advance(triangleCount(level, level.groups[g]));
    });
    if (mayDefer) deferExpensiveGroups(level, results);
    Level next;
    for (std::size_t g = 0; g < results.size(); ++g) {
        LevelGroup& group = level.groups[g];
        if (group.isDeferred) continue;
        group.error = results[g].error;
        group.attributeError = results[g].attributeError;
        next.refinements.push_back({group.place, group.bounds, group.error, group.attributeError});
        const auto first = static_cast<std::uint32_t>(next.triangles.size());
        const Level& own = results[g].clusters;
        next.triangles.insert(next.triangles.end(), own.triangles.begin(), own.triangles.end());
        next.errors.insert(next.errors.end(), own.errors.begin(), own.errors.end());
        next.moved.insert(next.moved.end(), own.moved.begin(), own.moved.end());
        next.normals.insert(next.normals.end(), own.normals.begin(), own.normals.end());
        next.colors.insert(next.colors.end(), own.colors.begin(), own.colors.end());
        next.fields.insert(next.fields.end(), own.fields.begin(), own.fields.end());
        for (LevelCluster cluster : own.clusters) {
            cluster.firstTriangle += first;
            cluster.refinement = static_cast<std::uint32_t>(next.refinements.size() - 1);
            next.clusters.push_back(cluster);
        }
    }
    appendDeferred(level, next);
    return next;
}

} // namespace gnomon::levels
