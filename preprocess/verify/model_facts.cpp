#include "preprocess/verify/model_facts.h"

#include "hierarchy/cut_rule.h"
#include "hierarchy/validation.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace gnomon::verify {

using namespace hierarchy;

namespace {

/// Creates the text that names a group by page and index, for the description of a failed test.
class GroupName {
public:
    GroupName(std::size_t page, std::size_t group) : page_(page), group_(group) {}

    auto operator()(const char* what) const {
        return [*this, what] { return "page " + std::to_string(page_) + " group " + std::to_string(group_) + what; };
    }

private:
    std::size_t page_;
    std::size_t group_;
};

void addSums(const Page& page, const Grid& grid, PageFacts& facts) {
    LevelInfo& sums = facts.sums;
    sums.triangles = page.triangles.size();
    sums.clusters = page.clusters.size();
    sums.groups = page.groups.size();
    for (const Cluster& cluster : page.clusters)
        sums.maxError = std::max(sums.maxError, storedError(page, cluster, grid.snapError()));
    for (const Refinement& refinement : page.refinements)
        sums.maxAttributeError = std::max(sums.maxAttributeError, refinement.attributeError);
    for (const Group& group : page.groups)
        for (std::uint32_t c = 0; c < group.clusterCount && std::isinf(group.error); ++c)
            facts.rootTriangles += page.clusters[group.firstCluster + c].triangleCount;
}

void testNesting(const Page& page, const Group& group, const Grid& grid, const GroupName& words, Check& check) {
    check.test(encloses(group.bounds, grid.local(group.box)), words(" has vertices outside its bounds"));
    for (std::uint32_t c = 0; c < group.clusterCount; ++c) {
        const std::uint32_t refinement = page.clusters[group.firstCluster + c].refinement;
        if (refinement == kNone) continue;
        const Sphere& inner = page.refinements[refinement].bounds;
        const double reach = glm::length(inner.center - group.bounds.center) + inner.radius;
        check.worst = std::max(check.worst, reach - group.bounds.radius);
        check.test(encloses(group.bounds, inner), words(" has bounds that do not enclose those of what it refines to"));
    }
}

void testErrors(const Page& page, const Group& group, const Grid& grid, const GroupName& words, Check& check) {
    for (std::uint32_t c = 0; c < group.clusterCount; ++c) {
        const Cluster& cluster = page.clusters[group.firstCluster + c];
        const double finer = storedError(page, cluster, grid.snapError());
        check.worst = std::max(check.worst, finer - group.error);
        check.test(group.error >= finer, words(" has an error below that of one of its clusters"));
        if (cluster.refinement == kNone || std::isinf(group.error)) continue;
        check.test(
            group.attributeError >= page.refinements[cluster.refinement].attributeError,
            words(" has an error of attributes below that of one of its clusters"));
    }
}

} // namespace

PageFacts factsOf(const Page& page, std::size_t number, const Grid& grid) {
    PageFacts facts;
    facts.level = page.level;
    addSums(page, grid, facts);
    facts.fault = pageFault(page);
    facts.groups = page.groups;
    facts.refinements = page.refinements;
    facts.isUsed.resize(page.refinements.size());
    for (const Cluster& cluster : page.clusters)
        if (cluster.refinement != kNone) facts.isUsed[cluster.refinement] = true;
    for (std::size_t g = 0; g < page.groups.size(); ++g) {
        testNesting(page, page.groups[g], grid, {number, g}, facts.nesting);
        testErrors(page, page.groups[g], grid, {number, g}, facts.monotoneError);
    }
    return facts;
}

ModelFacts readFacts(const ModelFile& file, Progress& progress) {
    ModelFacts model;
    model.summary = file.summary();
    model.pages.resize(file.pages().size());
    std::vector<std::string> damage(file.pages().size());
    progress.stage("read pages", "pages", model.pages.size());
    tbb::parallel_for(std::size_t{0}, model.pages.size(), [&](std::size_t page) {
        try {
            model.pages[page] = factsOf(file.readPage(static_cast<std::uint32_t>(page)), page, model.summary.grid);
        } catch (const PageDamage& error) {
            damage[page] = error.what();
        }
        progress.advance(1);
    });
    for (std::string& line : damage)
        if (!line.empty()) model.damage.push_back(std::move(line));
    return model;
}

Bytes factsBytes(std::span<const PageInfo> pages) {
    Bytes sum;
    for (const PageInfo& info : pages)
        sum.count += sizeof(PageInfo) + info.children.size() * sizeof(std::uint32_t) + sizeof(PageFacts) +
                     std::uint64_t{info.groupCount} * sizeof(Group) +
                     std::uint64_t{info.refinementCount} * sizeof(Refinement);
    return sum;
}

} // namespace gnomon::verify
