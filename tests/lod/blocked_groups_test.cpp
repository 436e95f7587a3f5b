// Cuts around groups that may not be refined, the demands of a cut, and the trees that it walks.
#include "cluster_chains.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

namespace gnomon::lod {
namespace {

using tests::Chains;
using tests::ClusterId;
using tests::clustersOf;
using tests::sharedModel;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct BlockedScene {
    explicit BlockedScene(Random& random)
        : resident(tests::randomResidency(random, sharedModel())),
          view(tests::randomView(random, sharedModel().bounds)),
          rule(view, tests::randomCasters(random, view)),
          errorPixels(std::exp(random.uniform(-5, 2))) {}

    CutQuery query() const { return {&sharedModel().trees, resident, &rule, errorPixels, volumes, &blocked}; }

    std::vector<const hierarchy::Page*> resident;
    DetailView view;
    ErrorRule rule;
    std::vector<ConvexVolume> volumes{ConvexVolume{}}; // all of space
    hierarchy::BlockedGroups blocked;
    double errorPixels = 1;
};

/// Blocks some groups, and all that is below a blocked one.
hierarchy::BlockedGroups randomBlocked(Random& random) {
    hierarchy::BlockedGroups blocked;
    for (std::uint32_t p = 0; p < sharedModel().all.size(); ++p) {
        const hierarchy::Page& page = *sharedModel().all[p];
        for (std::uint32_t g = 0; g < page.groups.size(); ++g) {
            const hierarchy::Group& group = page.groups[g];
            if (group.error < kInfinite && random.below(10) == 0) blocked.insert({p, g});
            if (!blocked.contains({p, g})) continue;
            for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
                if (page.clusters[c].refinement != hierarchy::kNone)
                    blocked.insert(page.refinements[page.clusters[c].refinement].group);
        }
    }
    return blocked;
}

/// How many clusters of a chain are in a set.
std::ptrdiff_t countIn(const std::vector<ClusterId>& chain, const std::set<ClusterId>& clusters) {
    return std::count_if(chain.begin(), chain.end(), [&](const ClusterId& id) { return clusters.contains(id); });
}

/// Whether a cluster belongs to one of the groups.
bool isOfOne(const hierarchy::BlockedGroups& groups, const ClusterId& id) {
    const hierarchy::Page& page = *sharedModel().all[id.page];
    for (std::uint32_t g = 0; g < page.groups.size(); ++g) {
        const std::uint32_t first = page.groups[g].firstCluster;
        if (id.cluster >= first && id.cluster < first + page.groups[g].clusterCount)
            return groups.contains({id.page, g});
    }
    return false;
}

TEST(BlockedGroups, StayUnrefinedAndLeaveNoHole) {
    Random random(41);
    const Chains chains(sharedModel());
    std::size_t coarser = 0;
    for (int trial = 0; trial < 60; ++trial) {
        BlockedScene scene(random);
        const std::set<ClusterId> free = clustersOf(cut(scene.query()).lists.image);
        scene.blocked = randomBlocked(random);
        const std::set<ClusterId> drawn = clustersOf(cut(scene.query()).lists.image);
        for (const ClusterId& id : drawn)
            EXPECT_FALSE(isOfOne(scene.blocked, id));
        for (int i = 0; i < 100; ++i) {
            const std::vector<ClusterId> chain = chains.randomChain(random);
            EXPECT_EQ(countIn(chain, drawn), 1);
            EXPECT_EQ(countIn(chain, free), 1);
        }
        coarser += drawn != free ? 1 : 0;
    }
    EXPECT_GT(coarser, 30U);
}

TEST(BlockedGroups, AreAskedForAllTheSame) {
    Random random(42);
    for (int trial = 0; trial < 30; ++trial) {
        BlockedScene scene(random);
        const auto pages = [&] {
            std::map<std::uint32_t, double> result;
            for (const hierarchy::PageDemand& used : demand(scene.query()))
                result.emplace(used.page, used.pixels);
            return result;
        };
        const std::map<std::uint32_t, double> free = pages();
        scene.blocked = randomBlocked(random);
        EXPECT_EQ(pages(), free) << "a page that is damaged is no reason to forget the others";
    }
}

/// The most pixels of anything in view or in shadow that resident pages know of each page.
std::map<std::uint32_t, double> slowDemand(const BlockedScene& scene) {
    std::map<std::uint32_t, double> result;
    for (std::uint32_t p = 0; p < scene.resident.size(); ++p) {
        if (sharedModel().table[p].maxError == kInfinite) result[p] = kInfinite;
        if (scene.resident[p] == nullptr) continue;
        for (const hierarchy::Refinement& finer : scene.resident[p]->refinements) {
            const double pixels = scene.rule.pixels(finer.bounds, tests::largerError(finer));
            if (pixels > scene.errorPixels) result[finer.group.page] = std::max(result[finer.group.page], pixels);
        }
    }
    return result;
}

TEST(Demand, NamesEachPageOnceInOrderWithItsPixels) {
    Random random(43);
    for (int trial = 0; trial < 60; ++trial) {
        const BlockedScene scene(random);
        const std::map<std::uint32_t, double> expected = slowDemand(scene);
        const Cut now = cut(scene.query());
        std::size_t named = 0;
        for (const std::vector<hierarchy::PageDemand>* demands : {&now.used, &now.wanted}) {
            for (std::size_t i = 0; i < demands->size(); ++i) {
                const hierarchy::PageDemand& one = (*demands)[i];
                EXPECT_TRUE(i == 0 || (*demands)[i - 1].page < one.page);
                EXPECT_EQ(scene.resident[one.page] != nullptr, demands == &now.used);
                ASSERT_TRUE(expected.contains(one.page));
                // In view exactly; of a shadow's edge some of its casters may suffice to say that it is wanted.
                const double pixels = expected.at(one.page);
                EXPECT_LE(one.pixels, pixels);
                EXPECT_GT(one.pixels, scene.errorPixels);
            }
            named += demands->size();
        }
        EXPECT_EQ(named, expected.size());
        EXPECT_EQ(now.errorPixels, scene.errorPixels);
    }
}

TEST(PageTrees, HoldEveryPageOnceCoarsestLevelFirst) {
    const PageTrees& trees = sharedModel().trees;
    std::set<std::uint32_t> pages;
    std::uint32_t level = std::numeric_limits<std::uint32_t>::max();
    for (const PageTrees::Level& one : trees.levels()) {
        ASSERT_FALSE(one.items.empty());
        const std::uint32_t own = sharedModel().table[one.items[0].page].level;
        EXPECT_LT(own, level);
        level = own;
        EXPECT_EQ(one.tree.order().size(), one.items.size());
        for (const PageTrees::PageItem& item : one.items) {
            const hierarchy::PageInfo& info = sharedModel().table[item.page];
            EXPECT_TRUE(pages.insert(item.page).second);
            EXPECT_EQ(info.level, own);
            EXPECT_EQ(item.error, info.maxError);
            EXPECT_EQ(item.bounds.radius, info.bounds.radius);
            EXPECT_EQ(item.holdsRoot, info.maxError == kInfinite);
        }
    }
    EXPECT_EQ(level, 0U);
    EXPECT_EQ(pages.size(), sharedModel().table.size());
    EXPECT_EQ(trees.grid().stepExponent, sharedModel().model.summary.grid.stepExponent);
}

// Pages are the finest piece of work: a cut is the same however the visits are dealt out, in the order of the parts.
TEST(CutPart, PartsOfAnySizeMakeTheSameCut) {
    Random random(44);
    for (int trial = 0; trial < 20; ++trial) {
        const BlockedScene scene(random);
        std::vector<std::uint32_t> missing;
        const CutQuery query = scene.query();
        const std::vector<PageVisit> visits = visitedPages(query, missing);
        std::vector<CutPart> parts(1, CutPart(query));
        for (const PageVisit& visit : visits) {
            if (random.below(3) == 0) parts.emplace_back(query);
            parts.back().add(visit);
        }
        const Cut whole = cut(query);
        const Cut joined = CutPart::joined(query, parts, missing);
        EXPECT_EQ(joined.lists.image.ranges, whole.lists.image.ranges);
        EXPECT_EQ(joined.lists.image.clusters, whole.lists.image.clusters);
        EXPECT_EQ(joined.lists.image.triangles, whole.lists.image.triangles);
        EXPECT_EQ(joined.used.size(), whole.used.size());
        EXPECT_EQ(joined.wanted.size(), whole.wanted.size());
        EXPECT_EQ(joined.groupsTested, whole.groupsTested);
        EXPECT_EQ(joined.clustersTested, whole.clustersTested);
        EXPECT_EQ(joined.achievedErrorPixels, whole.achievedErrorPixels);
        std::uint64_t groups = 0;
        for (const PageVisit& visit : visits)
            groups += visit.mask.touching != 0 ? scene.resident[visit.page]->groups.size() : 0;
        EXPECT_EQ(whole.groupsTested, groups);
    }
}

} // namespace
} // namespace gnomon::lod
