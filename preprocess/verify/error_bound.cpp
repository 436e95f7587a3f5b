#include "preprocess/verify/error_bound.h"

#include "core/formatted.h"
#include "core/random.h"
#include "hierarchy/cut_rule.h"
#include "preprocess/verify/uniform_cut.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <map>
#include <set>

namespace gnomon::verify {

using namespace hierarchy;

namespace {

constexpr std::size_t kMaxCuts = 8;
// The number of random samples per direction and cut. It is also the number of sampled corners.
constexpr std::size_t kPointSamples = 60'000;
constexpr std::size_t kDenseGroups = 150; // number of densely sampled groups per cut
// Number of samples per triangle of a densely sampled group, in addition to its corners.
constexpr std::uint32_t kDensePoints = 4;
// Max number of sampled corners of level 0 below the densely sampled groups of one cut.
constexpr std::size_t kDenseCorners = 150'000;

/// The tolerance for comparing distances, relative to the bound and in grid steps. Coordinates are below 2^31 grid
/// steps, so smaller differences are rounding errors.
constexpr double kRounding = 1e-9;

/// A sampled point on a triangle.
struct Sample {
    std::uint32_t triangle = 0;
    glm::dvec3 point{0};
};

/// Returns a random point on the triangle with the index `triangle`. Points are uniformly distributed over its area.
Sample onTriangle(const TriangleSoup& soup, std::uint32_t triangle, Random& random) {
    double u = random.unit();
    double v = random.unit();
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    return {triangle, soup.point(triangle, u, v)};
}

/// Returns kPointSamples points that are uniformly distributed over the area of `soup`, and as many random corners. The
/// samples are sorted by triangle.
std::vector<Sample> drawSamples(const TriangleSoup& soup, Random& random) {
    std::vector<Sample> samples;
    if (soup.triangles.empty()) return samples;
    const auto count = static_cast<std::uint32_t>(soup.triangles.size());
    std::vector<double> upTo(count);
    double area = 0;
    for (std::uint32_t t = 0; t < count; ++t)
        upTo[t] = area += soup.area(t);
    for (std::size_t i = 0; i < kPointSamples; ++i) {
        const auto it = std::upper_bound(upTo.begin(), upTo.end(), random.unit() * area);
        samples.push_back(onTriangle(soup, std::min(static_cast<std::uint32_t>(it - upTo.begin()), count - 1), random));
        const auto triangle = static_cast<std::uint32_t>(random.below(count));
        samples.push_back({triangle, soup.corner(triangle, random.below(3))});
    }
    std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.triangle < b.triangle; });
    return samples;
}

/// Returns, for each sample, the nearest triangle of `tree` and its distance.
std::vector<TriangleTree::Nearest> nearestTo(const std::vector<Sample>& samples, const TriangleTree& tree) {
    std::vector<TriangleTree::Nearest> found(samples.size());
    constexpr std::size_t kRun = 256;
    tbb::parallel_for(std::size_t{0}, (samples.size() + kRun - 1) / kRun, [&](std::size_t run) {
        std::uint32_t hint = kNone;
        for (std::size_t i = run * kRun; i < std::min(samples.size(), (run + 1) * kRun); ++i) {
            found[i] = tree.nearest(samples[i].point, hint);
            hint = found[i].triangle;
        }
    });
    return found;
}

/// Returns the error limits of the tested uniform cuts. They are some of the levels' max errors, including those of the
/// finest and the coarsest level.
std::vector<double> cutErrors(const ModelSummary& summary) {
    std::set<double> errors;
    for (const LevelInfo& level : summary.levels)
        errors.insert(level.maxError);
    std::vector<double> all(errors.begin(), errors.end());
    std::vector<double> thinned;
    for (std::size_t i = 0; i < std::min(all.size(), kMaxCuts); ++i)
        thinned.push_back(all[i * (all.size() - 1) / std::max<std::size_t>(std::min(all.size(), kMaxCuts) - 1, 1)]);
    return thinned;
}

/// Compares the uniform cuts of one model with its source mesh.
class Comparison {
public:
    Comparison(const LoadedModel& model, const TriangleSoup& source, std::uint64_t seed)
        : model_(model), sourceTree_(source), finest_(uniformCut(model, 0)), random_(mix64(seed)) {
        for (const Page& page : model.pages)
            for (std::uint32_t g = 0; g < page.groups.size(); ++g)
                for (std::uint32_t c = 0; c < page.groups[g].clusterCount; ++c)
                    groupOfCluster_.push_back(
                        model.firstGroup[static_cast<std::size_t>(&page - model.pages.data())] + g);
        for (const UniformCut::Part& part : finest_.parts)
            finestPart_[model.firstCluster[part.page] + part.cluster] = part.firstTriangle;
        sourceSamples_ = drawSamples(source, random_);
        finestNearest_ = nearestTo(sourceSamples_, TriangleTree(finest_.soup));
    }

    void compareAt(double limit) {
        const UniformCut cut = uniformCut(model_, limit);
        check_.cuts.push_back({cut.soup.triangles.size(), limit});
        largest_.clear();
        compareCut(cut, drawSamples(cut.soup, random_), limit);
        compareSource(cut, limit);
        compareCut(cut, denseSamples(cut), limit);
        compareBelow(cut);
        for (const std::uint32_t group : dense_)
            if (const double sampled = largest_[group]; sampled > 0) ratios_.push_back(errorOf_[group] / sampled);
    }

    Check result() {
        if (!ratios_.empty()) {
            std::nth_element(
                ratios_.begin(), ratios_.begin() + static_cast<std::ptrdiff_t>(ratios_.size() / 2), ratios_.end());
            check_.tightness = ratios_[ratios_.size() / 2];
        }
        return std::move(check_);
    }

private:
    /// Returns the number of the group that a cluster of a cut was simplified from, or kNone at level 0. Groups are
    /// numbered across pages.
    std::uint32_t refinedGroup(const UniformCut::Part& part) {
        const Page& page = model_.pages[part.page];
        const std::uint32_t refinement = page.clusters[part.cluster].refinement;
        if (refinement == kNone) return kNone;
        const std::uint32_t group = model_.groupNumber(page.refinements[refinement].group);
        errorOf_[group] = page.refinements[refinement].error;
        return group;
    }

    void judge(double sampled, double bound, double limit, const char* which, const glm::dvec3& point) {
        double& largest = check_.cuts.back().sampledLargest;
        largest = std::max(largest, sampled);
        const double share = bound > 0 ? sampled / bound : (sampled > 0 ? std::numeric_limits<double>::infinity() : 0);
        check_.worst = std::max(check_.worst, share);
        check_.test(sampled <= bound * (1 + kRounding) + model_.summary.grid.step() * kRounding, [&] {
            const glm::dvec3 world = model_.summary.grid.origin + point;
            return std::string(which) + formatted(" at %.9g,%.9g,%.9g", world.x, world.y, world.z) +
                   formatted(
                       ", in the cut of error %g, is %g away where the stored error is %g", limit, sampled, bound);
        });
    }

    void compareCut(const UniformCut& cut, const std::vector<Sample>& samples, double limit) {
        const auto nearest = nearestTo(samples, sourceTree_);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const UniformCut::Part& part = cut.partOf(samples[i].triangle);
            const Page& page = model_.pages[part.page];
            const double bound = storedError(page, page.clusters[part.cluster], model_.summary.grid.snapError());
            judge(nearest[i].distance, bound, limit, "a point of the cut", samples[i].point);
            note(refinedGroup(part), nearest[i].distance);
        }
    }

    void compareSource(const UniformCut& cut, double limit) {
        const auto nearest = nearestTo(sourceSamples_, TriangleTree(cut.soup));
        const std::vector<double> bounds = boundsInCut(model_, limit);
        double squares = 0;
        for (std::size_t i = 0; i < nearest.size(); ++i) {
            squares += nearest[i].distance * nearest[i].distance;
            const UniformCut::Part& finest = finest_.partOf(finestNearest_[i].triangle);
            const double coarse = bounds[groupOfCluster_[model_.firstCluster[finest.page] + finest.cluster]];
            const double bound =
                std::max(coarse, model_.summary.grid.snapError()) + (coarse > 0 ? finestNearest_[i].distance : 0);
            judge(nearest[i].distance, bound, limit, "a point of the source", sourceSamples_[i].point);
            note(refinedGroup(cut.partOf(nearest[i].triangle)), nearest[i].distance);
        }
        if (!nearest.empty()) check_.cuts.back().sampledRms = std::sqrt(squares / static_cast<double>(nearest.size()));
    }

    /// Returns the triangles of level 0 from which the densely sampled groups were simplified, as ranges of triangles
    /// of the finest cut.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> partsBelow() const {
        // Pairs of the index of the first triangle and the number of triangles.
        std::vector<std::pair<std::uint32_t, std::uint32_t>> parts;
        std::vector<std::uint32_t> open = dense_;
        std::vector<bool> isKnown(model_.firstGroup.back());
        while (!open.empty()) {
            const std::uint32_t number = open.back();
            open.pop_back();
            if (isKnown[number]) continue;
            isKnown[number] = true;
            const auto above = std::upper_bound(model_.firstGroup.begin(), model_.firstGroup.end(), number);
            const auto p = static_cast<std::size_t>(above - model_.firstGroup.begin()) - 1;
            const Page& page = model_.pages[p];
            const Group& group = page.groups[number - model_.firstGroup[p]];
            for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
                const Cluster& cluster = page.clusters[c];
                if (cluster.refinement != kNone)
                    open.push_back(model_.groupNumber(page.refinements[cluster.refinement].group));
                else if (const auto part = finestPart_.find(model_.firstCluster[p] + c); part != finestPart_.end())
                    parts.emplace_back(part->second, cluster.triangleCount);
            }
        }
        std::sort(parts.begin(), parts.end());
        return parts;
    }

    /// Measures the distances from level 0 to the cut, below the densely sampled groups. This finds small features that
    /// the simplification removed. They have no points in the cut, and random source points seldom hit them. The
    /// vertices of level 0 are vertices of the source.
    void compareBelow(const UniformCut& cut) {
        std::size_t corners = 0;
        const auto parts = partsBelow();
        for (const auto& [first, count] : parts)
            corners += std::size_t{3} * count;
        const std::size_t stride = corners / kDenseCorners + 1;
        std::vector<Sample> samples;
        std::size_t corner = 0;
        for (const auto& [first, count] : parts)
            for (std::uint32_t k = 0; k < 3 * count; ++k)
                if (corner++ % stride == 0)
                    samples.push_back({first + k / 3, finest_.soup.corner(first + k / 3, k % 3)});
        const auto nearest = nearestTo(samples, TriangleTree(cut.soup));
        for (const TriangleTree::Nearest& found : nearest)
            note(refinedGroup(cut.partOf(found.triangle)), found.distance - model_.summary.grid.snapError());
    }

    void note(std::uint32_t group, double distance) {
        if (group == kNone) return;
        double& largest = largest_[group];
        largest = std::max(largest, distance);
    }

    /// Selects a few random groups, and returns sample points on the triangles that were simplified from these groups:
    /// their corners and several points inside each triangle.
    std::vector<Sample> denseSamples(const UniformCut& cut) {
        std::map<std::uint32_t, std::vector<const UniformCut::Part*>> byGroup;
        for (const UniformCut::Part& part : cut.parts)
            if (const std::uint32_t group = refinedGroup(part); group != kNone) byGroup[group].push_back(&part);
        std::vector<std::uint32_t> groups;
        groups.reserve(byGroup.size());
        for (const auto& entry : byGroup)
            groups.push_back(entry.first);
        dense_.clear();
        std::vector<Sample> samples;
        while (dense_.size() < kDenseGroups && !groups.empty()) {
            const std::size_t chosen = random_.below(groups.size());
            dense_.push_back(groups[chosen]);
            for (const UniformCut::Part* part : byGroup[groups[chosen]])
                addDense(cut, *part, samples);
            groups[chosen] = groups.back();
            groups.pop_back();
        }
        return samples;
    }

    void addDense(const UniformCut& cut, const UniformCut::Part& part, std::vector<Sample>& samples) {
        const std::uint32_t count = model_.pages[part.page].clusters[part.cluster].triangleCount;
        for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + count; ++t) {
            for (std::size_t k = 0; k < 3; ++k)
                samples.push_back({t, cut.soup.corner(t, k)});
            for (std::uint32_t i = 0; i < kDensePoints; ++i)
                samples.push_back(onTriangle(cut.soup, t, random_));
        }
    }

    const LoadedModel& model_;
    TriangleTree sourceTree_;
    UniformCut finest_;
    Random random_;
    // The first triangle of each cluster in `finest_`. Clusters are numbered across pages.
    std::map<std::uint32_t, std::uint32_t> finestPart_;
    std::vector<std::uint32_t> groupOfCluster_; // group per cluster, numbered across pages
    std::vector<Sample> sourceSamples_;
    std::vector<TriangleTree::Nearest> finestNearest_; // nearest triangle of level 0 per sample of the source
    std::map<std::uint32_t, double> errorOf_;          // stored error per group
    std::map<std::uint32_t, double> largest_;          // largest sampled distance per group, in the current cut
    std::vector<std::uint32_t> dense_;
    std::vector<double> ratios_;
    Check check_{"error_bound"};
};

} // namespace

Check checkErrorBound(const LoadedModel& model, const TriangleSoup& source, std::uint64_t seed, Progress& progress) {
    Check check{"error_bound"};
    if (source.triangles.empty() || model.summary.levels.empty() || model.summary.levels[0].triangles == 0) {
        check.test(false, [] { return std::string("the source or the model has no triangles to compare"); });
        return check;
    }
    const std::vector<double> errors = cutErrors(model.summary);
    progress.stage("compare with the source", "cuts", errors.size() + 1);
    Comparison comparison(model, source, seed);
    progress.advance(1);
    for (const double error : errors) {
        comparison.compareAt(error);
        progress.advance(1);
    }
    return comparison.result();
}

} // namespace gnomon::verify
