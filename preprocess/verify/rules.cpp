#include "preprocess/verify/rules.h"

#include <cmath>

namespace gnomon::verify {

using namespace hierarchy;

namespace {

bool same(const Sphere& a, const Sphere& b) {
    return a.center == b.center && a.radius == b.radius;
}

bool resolves(const ModelFacts& model, const PageFacts& page, const Refinement& refinement) {
    const GroupRef& ref = refinement.group;
    return ref.page < model.pages.size() && ref.group < model.pages[ref.page].groups.size() &&
           model.pages[ref.page].level < page.level;
}

/// Says, per page and group, whether a refinement refers to the group.
using NamedGroups = std::vector<std::vector<bool>>;

void checkRefinements(const ModelFacts& model, std::size_t pageIndex, NamedGroups& named, Check& check) {
    const PageFacts& page = model.pages[pageIndex];
    for (std::size_t r = 0; r < page.refinements.size(); ++r) {
        const Refinement& refinement = page.refinements[r];
        const auto words = [&](const char* what) {
            return [pageIndex, r, what] {
                return "page " + std::to_string(pageIndex) + " refinement " + std::to_string(r) + " " + what;
            };
        };
        check.test(page.isUsed[r], words("belongs to no cluster"));
        check.test(resolves(model, page, refinement), words("names no finer group"));
        if (!resolves(model, page, refinement)) continue;
        const Group& group = model.pages[refinement.group.page].groups[refinement.group.group];
        check.test(
            same(group.bounds, refinement.bounds) && group.error == refinement.error &&
                group.attributeError == refinement.attributeError,
            words("has bounds or an error that are not those of the group that it names"));
        named[refinement.group.page][refinement.group.group] = true;
    }
}

/// Checks that each group is a root or that a refinement refers to it. No view could ever draw another group.
void checkReachable(const ModelFacts& model, const NamedGroups& named, Check& check) {
    for (std::size_t p = 0; p < model.pages.size(); ++p)
        for (std::size_t g = 0; g < model.pages[p].groups.size(); ++g) {
            const bool isRoot = std::isinf(model.pages[p].groups[g].error);
            check.test(named[p][g] != isRoot, [&] {
                return "page " + std::to_string(p) + " group " + std::to_string(g) +
                       (isRoot ? " is a root, yet refines another" : " is no root, yet refines no other");
            });
        }
}

void checkSums(const ModelFacts& model, Check& check) {
    const ModelSummary& summary = model.summary;
    std::vector<LevelInfo> levels(summary.levels.size());
    std::uint64_t coarsest = 0;
    for (const PageFacts& page : model.pages) {
        check.test(page.level < levels.size(), [&] { return "a page has level " + std::to_string(page.level); });
        if (page.level >= levels.size()) return;
        LevelInfo& level = levels[page.level];
        level.triangles += page.sums.triangles;
        level.clusters += page.sums.clusters;
        level.groups += page.sums.groups;
        level.maxError = std::max(level.maxError, page.sums.maxError);
        level.maxAttributeError = std::max(level.maxAttributeError, page.sums.maxAttributeError);
        coarsest += page.rootTriangles;
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
    // If the build removed covered triangles, the counts cannot be compared exactly, because any number of parts of
    // such a triangle may remain.
    const bool hasParts = summary.dropped.contains("covered") && accounted >= summary.sourceTriangles;
    check.test(hasParts || accounted == summary.sourceTriangles, [&] {
        return "triangles of level 0 and dropped ones are " + std::to_string(accounted) + ", the source had " +
               std::to_string(summary.sourceTriangles);
    });
}

} // namespace

bool refinementsResolve(const ModelFacts& model) {
    for (const PageFacts& page : model.pages)
        for (const Refinement& refinement : page.refinements)
            if (!resolves(model, page, refinement)) return false;
    return true;
}

Check checkStructure(const ModelFacts& model) {
    Check check{"structure"};
    NamedGroups named;
    for (const PageFacts& page : model.pages)
        named.emplace_back(page.groups.size());
    for (std::size_t p = 0; p < model.pages.size(); ++p) {
        const auto& fault = model.pages[p].fault;
        check.test(!fault, [&] { return "page " + std::to_string(p) + ": " + *fault; });
        checkRefinements(model, p, named, check);
    }
    checkReachable(model, named, check);
    checkSums(model, check);
    return check;
}

Check checkNesting(const ModelFacts& model) {
    Check check{"nesting"};
    for (const PageFacts& page : model.pages)
        check.add(page.nesting);
    return check;
}

Check checkMonotoneError(const ModelFacts& model) {
    Check check{"monotone_error"};
    for (const PageFacts& page : model.pages)
        check.add(page.monotoneError);
    return check;
}

} // namespace gnomon::verify
