#include "preprocess/verify/rules.h"

#include "hierarchy/cut_rule.h"
#include "hierarchy/validation.h"

#include <cmath>

namespace gnomon::verify {

using namespace hierarchy;

namespace {

std::string name(std::size_t page, std::size_t group) {
    return "page " + std::to_string(page) + " group " + std::to_string(group);
}

/// Calls `take(page, group, words)` for every group; `words(what)` makes the words for a failed test of it.
template <class Take>
void forEachGroup(const LoadedModel& model, const Take& take) {
    for (std::size_t p = 0; p < model.pages.size(); ++p)
        for (std::size_t g = 0; g < model.pages[p].groups.size(); ++g)
            take(model.pages[p], model.pages[p].groups[g], [p, g](const char* what) {
                return [p, g, what] { return name(p, g) + what; };
            });
}

bool same(const Sphere& a, const Sphere& b) {
    return a.center == b.center && a.radius == b.radius;
}

bool resolves(const LoadedModel& model, const Page& page, const Refinement& refinement) {
    const GroupRef& ref = refinement.group;
    return ref.page < model.pages.size() && ref.group < model.pages[ref.page].groups.size() &&
           model.pages[ref.page].level < page.level;
}

void checkRefinements(const LoadedModel& model, std::size_t pageIndex, std::vector<bool>& named, Check& check) {
    const Page& page = model.pages[pageIndex];
    std::vector<bool> used(page.refinements.size());
    for (const Cluster& cluster : page.clusters)
        if (cluster.refinement != kNone) used[cluster.refinement] = true;
    for (std::size_t r = 0; r < page.refinements.size(); ++r) {
        const Refinement& refinement = page.refinements[r];
        const auto words = [&](const char* what) {
            return [pageIndex, r, what] {
                return "page " + std::to_string(pageIndex) + " refinement " + std::to_string(r) + " " + what;
            };
        };
        check.test(used[r], words("belongs to no cluster"));
        check.test(resolves(model, page, refinement), words("names no finer group"));
        if (!resolves(model, page, refinement)) continue;
        const Group& group = model.group(refinement.group);
        check.test(
            same(group.bounds, refinement.bounds) && group.error == refinement.error &&
                group.attributeError == refinement.attributeError,
            words("has bounds or an error that are not those of the group that it names"));
        named[model.groupNumber(refinement.group)] = true;
    }
}

/// Every group is either a root or named by a refinement, or no cut would ever draw it.
void checkReachable(const LoadedModel& model, const std::vector<bool>& named, Check& check) {
    for (std::size_t p = 0; p < model.pages.size(); ++p)
        for (std::uint32_t g = 0; g < model.pages[p].groups.size(); ++g) {
            const bool isRoot = std::isinf(model.pages[p].groups[g].error);
            check.test(named[model.firstGroup[p] + g] != isRoot, [&] {
                return name(p, g) + (isRoot ? " is a root, yet refines another" : " is no root, yet refines no other");
            });
        }
}

void checkSums(const LoadedModel& model, Check& check) {
    const ModelSummary& summary = model.summary;
    std::vector<LevelInfo> levels(summary.levels.size());
    std::uint64_t coarsest = 0;
    for (const Page& page : model.pages) {
        check.test(page.level < levels.size(), [&] { return "a page has level " + std::to_string(page.level); });
        if (page.level >= levels.size()) return;
        LevelInfo& level = levels[page.level];
        level.triangles += page.triangles.size();
        level.clusters += page.clusters.size();
        level.groups += page.groups.size();
        for (const Cluster& cluster : page.clusters)
            level.maxError = std::max(level.maxError, storedError(page, cluster, summary.grid.snapError()));
        for (const Refinement& refinement : page.refinements)
            level.maxAttributeError = std::max(level.maxAttributeError, refinement.attributeError);
        for (const Group& group : page.groups)
            for (std::uint32_t c = 0; c < group.clusterCount && std::isinf(group.error); ++c)
                coarsest += page.clusters[group.firstCluster + c].triangleCount;
    }
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const LevelInfo& a = levels[i];
        const LevelInfo& b = summary.levels[i];
        check.test(
            a.triangles == b.triangles && a.clusters == b.clusters && a.groups == b.groups &&
                a.maxError == b.maxError && a.maxAttributeError == b.maxAttributeError,
            [&] { return "the summary of level " + std::to_string(i) + " is not the sum of its pages"; });
    }
    check.test(coarsest == summary.coarsestTriangles, [&] {
        return "the root groups have " + std::to_string(coarsest) + " triangles, the summary says " +
               std::to_string(summary.coarsestTriangles);
    });
    std::uint64_t accounted = levels.empty() ? 0 : levels[0].triangles;
    for (const auto& [reason, count] : summary.dropped)
        accounted += reason == "not_a_polygon" ? 0 : count;
    check.test(accounted == summary.sourceTriangles, [&] {
        return "triangles of level 0 and dropped ones are " + std::to_string(accounted) + ", the source had " +
               std::to_string(summary.sourceTriangles);
    });
}

} // namespace

bool refinementsResolve(const LoadedModel& model) {
    for (const Page& page : model.pages)
        for (const Refinement& refinement : page.refinements)
            if (!resolves(model, page, refinement)) return false;
    return true;
}

Check checkStructure(const LoadedModel& model) {
    Check check{"structure"};
    std::vector<bool> named(model.firstGroup.back());
    for (std::size_t p = 0; p < model.pages.size(); ++p) {
        const auto fault = pageFault(model.pages[p]);
        check.test(!fault, [&] { return "page " + std::to_string(p) + ": " + *fault; });
        checkRefinements(model, p, named, check);
    }
    checkReachable(model, named, check);
    checkSums(model, check);
    return check;
}

Check checkNesting(const LoadedModel& model) {
    Check check{"nesting"};
    forEachGroup(model, [&](const Page& page, const Group& group, const auto& words) {
        check.test(
            encloses(group.bounds, model.summary.grid.local(group.box)), words(" has vertices outside its bounds"));
        for (std::uint32_t c = 0; c < group.clusterCount; ++c) {
            const std::uint32_t refinement = page.clusters[group.firstCluster + c].refinement;
            if (refinement == kNone) continue;
            const Sphere& inner = page.refinements[refinement].bounds;
            const double reach = glm::length(inner.center - group.bounds.center) + inner.radius;
            check.worst = std::max(check.worst, reach - group.bounds.radius);
            check.test(
                encloses(group.bounds, inner), words(" has bounds that do not enclose those of what it refines to"));
        }
    });
    return check;
}

Check checkMonotoneError(const LoadedModel& model) {
    Check check{"monotone_error"};
    forEachGroup(model, [&](const Page& page, const Group& group, const auto& words) {
        for (std::uint32_t c = 0; c < group.clusterCount; ++c) {
            const Cluster& cluster = page.clusters[group.firstCluster + c];
            const double finer = storedError(page, cluster, model.summary.grid.snapError());
            check.worst = std::max(check.worst, finer - group.error);
            check.test(group.error >= finer, words(" has an error below that of one of its clusters"));
            if (cluster.refinement == kNone || std::isinf(group.error)) continue;
            check.test(
                group.attributeError >= page.refinements[cluster.refinement].attributeError,
                words(" has an error of attributes below that of one of its clusters"));
        }
    });
    return check;
}

} // namespace gnomon::verify
