#include "preprocess/verify/cracks.h"

#include "core/random.h"
#include "hierarchy/cut_rule.h"
#include "preprocess/verify/crack_cells.h"
#include "preprocess/verify/locked_edges.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <functional>
#include <sstream>

namespace gnomon::verify {

using namespace hierarchy;

namespace {

/// A view for a view-dependent cut. The cut refines a group if the group's error exceeds `threshold` times the distance
/// from `eye`. The threshold is an error in world units per unit of distance.
struct View {
    glm::dvec3 eye{0}; // in local space
    double threshold = 0;

    bool operator()(double error, const Sphere& bounds) const { return error > threshold * distance(bounds, eye); }
};

/// Draws random views: near the model, on it, inside it and far from it. The threshold of a view is such that the error
/// of a random group of a random level is exactly at the limit.
class ViewSource {
public:
    /// Creates a generator of views. `surfacePoint(random)` returns a random vertex of the model.
    ViewSource(const ModelSummary& summary, std::function<GridPoint(Random&)> surfacePoint)
        : grid_(summary.grid), surfacePoint_(std::move(surfacePoint)), groups_(summary.levels.size()) {
        bounds_ = {summary.bounds.min - grid_.origin, summary.bounds.max - grid_.origin};
    }

    /// Adds the groups of a page, from which views are drawn. All groups must be added before the first view.
    void add(std::uint32_t level, std::span<const Group> groups) {
        for (const Group& group : groups)
            if (std::isfinite(group.error)) groups_[level].push_back(&group);
    }

    std::vector<View> draw(std::uint64_t count, std::uint64_t seed) {
        std::erase_if(groups_, [](const auto& level) { return level.empty(); });
        std::vector<View> views;
        for (std::uint64_t i = 0; i < count; ++i) {
            Random random(mix64(seed) + i);
            views.push_back(draw(random));
        }
        return views;
    }

private:
    View draw(Random& random) const {
        View view;
        view.eye = eye(random);
        if (groups_.empty()) return view;
        const auto& level = groups_[random.below(groups_.size())];
        const Group& group = *level[random.below(level.size())];
        const double span = std::max(glm::length(bounds_.extent()), 1e-300);
        const double away = std::max(distance(group.bounds, view.eye), random.uniform(1e-4, 1) * span);
        view.threshold = group.drawnError() / away * std::exp2(random.uniform(-1, 1));
        return view;
    }

    glm::dvec3 eye(Random& random) const {
        const glm::dvec3 unit(random.unit(), random.unit(), random.unit());
        switch (random.below(4)) {
        case 0:
            return bounds_.min + unit * bounds_.extent();
        case 1:
            return grid_.local(surfacePoint_(random));
        case 2:
            return bounds_.center() + (unit - 0.5) * 3.0 * (bounds_.extent() + glm::length(bounds_.extent()) * 0.1);
        default:
            return bounds_.center() + (unit - 0.5) * glm::length(bounds_.extent()) * std::exp2(random.uniform(2, 10));
        }
    }

    Grid grid_;
    std::function<GridPoint(Random&)> surfacePoint_;
    Box bounds_;
    std::vector<std::vector<const Group*>> groups_; // groups with finite errors, per level
};

/// Counts the triangles of one cut at the locked edges. The object is reused for many cuts, and only the entries that a
/// cut used are cleared.
struct CutEdges {
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint64_t> levels; // per edge: bit l is set if a triangle of the surface of level l has this edge
    std::vector<std::uint32_t> touched;
};

struct CutResult {
    std::uint64_t tested = 0;
    std::uint64_t cracks = 0;
    std::string detail;
};

void collect(const LoadedModel& model, const LockedEdges& edges, const View& view, CutEdges& cut) {
    cut.triangles.resize(edges.count());
    cut.levels.resize(edges.count());
    for (std::size_t p = 0; p < model.pages.size(); ++p) {
        const Page& page = model.pages[p];
        forEachDrawn(page, view, [&](const Group&, const Cluster& cluster) {
            const auto index = static_cast<std::uint32_t>(&cluster - page.clusters.data());
            for (const std::uint32_t edge : edges.edgesOf(model.firstCluster[p] + index)) {
                if (cut.triangles[edge]++ == 0) cut.touched.push_back(edge);
                cut.levels[edge] |= edges.levelsOf(model.firstCluster[p] + index);
            }
        });
    }
}

std::string words(const LockedEdges& edges, std::uint32_t edge, const EdgeLock& lock, std::uint64_t found) {
    std::ostringstream text;
    for (const bool second : {false, true}) {
        const GridPoint p = edges.end(edge, second);
        text << (second ? " and " : "the edge between grid points ") << p.x << ',' << p.y << ',' << p.z;
    }
    text << ", locked at level " << lock.level << " with " << lock.triangles << " triangles, has " << found;
    return text.str();
}

CutResult judge(const LockedEdges& edges, CutEdges& cut) {
    CutResult result;
    for (const std::uint32_t edge : cut.touched) {
        for (const EdgeLock& lock : edges.locks(edge)) {
            if ((cut.levels[edge] >> lock.level & 3U) == 0) continue;
            ++result.tested;
            if (cut.triangles[edge] == lock.triangles) continue;
            if (result.cracks++ == 0) result.detail = words(edges, edge, lock, cut.triangles[edge]);
        }
        cut.triangles[edge] = 0;
        cut.levels[edge] = 0;
    }
    cut.touched.clear();
    return result;
}

/// Searches for cracks at the locked edges of `cell` in all views and adds the results to `results`. `model` must
/// contain all pages that overlap the cell. Returns the number of locked edges.
std::size_t lookAt(
    const LoadedModel& model,
    const GridBox& cell,
    std::span<const View> views,
    std::vector<CutResult>& results,
    Progress& progress) {
    const LockedEdges edges(model, cell);
    tbb::enumerable_thread_specific<CutEdges> scratch;
    tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
        CutEdges& cut = scratch.local();
        collect(model, edges, views[i], cut);
        const CutResult found = judge(edges, cut);
        if (results[i].cracks == 0) results[i].detail = found.detail;
        results[i].tested += found.tested;
        results[i].cracks += found.cracks;
        progress.advance(0); // lets the user interrupt the search
    });
    return edges.count();
}

Check checkOf(const std::vector<CutResult>& results, std::uint64_t edges) {
    Check check{"cracks"};
    for (std::size_t i = 0; i < results.size(); ++i) {
        check.tested += results[i].tested;
        if (check.failed == 0 && results[i].cracks > 0)
            check.detail = results[i].detail + ", in cut " + std::to_string(i);
        check.failed += results[i].cracks;
        check.worst = std::max(check.worst, static_cast<double>(results[i].cracks));
    }
    if (check.failed == 0)
        check.detail = std::to_string(results.size()) + " cuts, " + std::to_string(edges) + " locked edges";
    return check;
}

} // namespace

std::uint64_t cutBytes(std::uint64_t cuts) {
    return cuts * 2 * (sizeof(View) + sizeof(CutResult));
}

Check checkCracks(const LoadedModel& model, std::uint64_t cuts, std::uint64_t seed, Progress& progress) {
    progress.stage("look for cracks", "models", 1);
    ViewSource source(model.summary, [&](Random& random) {
        const Page& page = model.pages[random.below(model.pages.size())];
        return page.vertices[random.below(page.vertices.size())].position;
    });
    for (const Page& page : model.pages)
        source.add(page.level, page.groups);
    std::vector<CutResult> results(cuts);
    const std::size_t edges = lookAt(model, kWholeGrid, source.draw(cuts, seed), results, progress);
    progress.advance(1);
    return checkOf(results, edges);
}

Check checkCracks(
    const ModelFile& file,
    const ModelFacts& facts,
    std::uint64_t cuts,
    std::uint64_t seed,
    std::span<const CrackCell> cells,
    Progress& progress) {
    ViewSource source(facts.summary, [&](Random& random) {
        const auto page = static_cast<std::uint32_t>(random.below(file.pages().size()));
        return file.readPage(page).vertices[random.below(file.pages()[page].vertexCount)].position;
    });
    for (const PageFacts& page : facts.pages)
        source.add(page.level, page.groups);
    const std::vector<View> views = source.draw(cuts, seed);
    std::uint64_t pages = 0;
    for (const CrackCell& cell : cells)
        pages += cell.pages.size();
    progress.stage("look for cracks", "pages", pages);
    std::vector<CutResult> results(cuts);
    std::uint64_t edges = 0;
    for (const CrackCell& cell : cells)
        edges += lookAt(loadPages(file, cell.pages, progress), cell.box, views, results, progress);
    return checkOf(results, edges);
}

} // namespace gnomon::verify
