// The cut that the trees find against the one that looking at every group finds, and what every cut must keep.
#include "cluster_chains.h"
#include "tests/support/rounding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

namespace gnomon::lod {
namespace {

using hierarchy::kNone;
using tests::Chains;
using tests::ClusterId;
using tests::clustersOf;
using tests::ModelInMemory;
using tests::sharedModel;

struct SlowCut {
    std::vector<std::set<ClusterId>> lists;
    std::uint64_t clustersTested = 0; // for the volumes behind the first
    std::set<std::uint32_t> used;
    std::set<std::uint32_t> wanted;
};

bool isRequested(const CutQuery& query, const Sphere& bounds, double error) {
    return query.rule->pixels(bounds, error) > query.errorPixels;
}

/// How many of the volumes behind the first `box` touches.
std::uint64_t touchedBehindTheFirst(const CutQuery& query, const hierarchy::GridBox& box) {
    std::uint64_t count = 0;
    for (std::size_t v = 1; v < query.volumes.size(); ++v)
        count += classify(query.volumes[v], query.trees->grid().local(box)) != Containment::Outside ? 1U : 0U;
    return count;
}

/// The rule for one cluster of a refined group: drawn unless its refinement is refined too, which takes residency.
void addSlowly(
    const CutQuery& query,
    const hierarchy::Page& page,
    const hierarchy::Group& group,
    const ClusterId& id,
    SlowCut& result) {
    const hierarchy::Cluster& cluster = page.clusters[id.cluster];
    if (cluster.refinement != kNone) {
        const hierarchy::Refinement& finer = page.refinements[cluster.refinement];
        const bool isResident = query.resident[finer.group.page] != nullptr;
        const bool isFinerAsked = isRequested(query, finer.bounds, tests::largerError(finer));
        if (isFinerAsked && !isResident) result.wanted.insert(finer.group.page);
        if (isFinerAsked && isResident) return;
    }
    result.clustersTested += touchedBehindTheFirst(query, group.box);
    for (std::size_t v = 0; v < query.volumes.size(); ++v)
        if (classify(query.volumes[v], query.trees->grid().local(cluster.box)) != Containment::Outside)
            result.lists[v].insert(id);
}

/// Every group of every resident page, no tree, no mask.
SlowCut slowCut(const CutQuery& query) {
    SlowCut result;
    result.lists.resize(query.volumes.size());
    for (std::uint32_t p = 0; p < query.resident.size(); ++p) {
        if (query.resident[p] == nullptr) continue;
        const hierarchy::Page& page = *query.resident[p];
        for (const hierarchy::Group& group : page.groups) {
            if (!isRequested(query, group.bounds, tests::largerError(group))) continue;
            result.used.insert(p);
            for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
                addSlowly(query, page, group, {p, c}, result);
        }
    }
    return result;
}

std::set<std::uint32_t> pagesOf(std::span<const hierarchy::PageDemand> demands) {
    std::set<std::uint32_t> result;
    for (const hierarchy::PageDemand& demand : demands)
        EXPECT_TRUE(result.insert(demand.page).second);
    return result;
}

/// One view with everything that a query points to.
struct Scene {
    Scene(Random& random, const ModelInMemory& model, std::vector<const hierarchy::Page*> pages)
        : trees(&model.trees),
          resident(std::move(pages)),
          view(tests::randomView(random, model.bounds)),
          casters(random.below(3) == 0 ? std::vector<CasterDetail>{} : tests::randomCasters(random, view)),
          rule(view, casters) {
        volumes.push_back(viewPyramid(view));
        for (const CasterDetail& caster : casters)
            volumes.push_back(caster.casters);
        errorPixels = std::exp(random.uniform(-5, 2));
    }

    CutQuery query() const { return {trees, resident, &rule, errorPixels, volumes}; }

    const PageTrees* trees;
    std::vector<const hierarchy::Page*> resident;
    DetailView view;
    std::vector<CasterDetail> casters;
    ErrorRule rule;
    std::vector<ConvexVolume> volumes;
    double errorPixels = 1;
};

TEST(Cut, TreesFindWhatBruteForceFinds) {
    Random random(31);
    std::size_t drawn = 0;
    std::uint64_t tested = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const Scene scene(random, sharedModel(), tests::randomResidency(random, sharedModel()));
        const Cut fast = cut(scene.query());
        const SlowCut slow = slowCut(scene.query());
        const std::vector<const DrawList*> lists = fast.lists.all();
        ASSERT_EQ(lists.size(), slow.lists.size());
        for (std::size_t v = 0; v < slow.lists.size(); ++v) {
            EXPECT_EQ(clustersOf(*lists[v]), slow.lists[v]) << "volume " << v;
            EXPECT_EQ(lists[v]->clusters, slow.lists[v].size());
            drawn += slow.lists[v].size();
        }
        EXPECT_EQ(pagesOf(fast.used), slow.used);
        EXPECT_EQ(pagesOf(fast.wanted), slow.wanted);
        EXPECT_EQ(fast.clustersTested, slow.clustersTested);
        tested += slow.clustersTested;
    }
    EXPECT_GT(drawn, 10000U);
    EXPECT_GT(tested, 1000U);
}

TEST(Cut, IsTheSameInEveryRoundingMode) {
    Random random(47);
    for (int trial = 0; trial < 40; ++trial) {
        const Scene scene(random, sharedModel(), tests::randomResidency(random, sharedModel()));
        const Cut usual = cut(scene.query());
        for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            const tests::RoundingMode rounding(mode);
            const ErrorRule rule(scene.view, scene.casters);
            CutQuery query = scene.query();
            query.rule = &rule;
            const Cut other = cut(query);
            EXPECT_TRUE(other.lists == usual.lists) << "rounding " << mode;
            EXPECT_EQ(pagesOf(other.wanted), pagesOf(usual.wanted));
            EXPECT_NEAR(other.achievedErrorPixels, usual.achievedErrorPixels, usual.achievedErrorPixels * 0x1p-24);
        }
    }
}

TEST(Cut, ABoxThatAVolumeMeetsInAFaceAloneIsTouched) {
    Random random(39);
    std::size_t drawn = 0;
    for (int trial = 0; trial < 60; ++trial) {
        Scene scene(random, sharedModel(), sharedModel().all);
        const hierarchy::Page& page = *scene.resident[random.below(scene.resident.size())];
        const Box box = scene.trees->grid().local(page.clusters[random.below(page.clusters.size())].box);
        glm::dvec3 axis(0);
        axis[trial % 3] = 1;
        const bool above = trial % 2 == 0;
        const Plane plane = above ? Plane{axis, -glm::dot(axis, box.max)} : Plane{-axis, glm::dot(axis, box.min)};
        scene.volumes.assign(1, ConvexVolume{{plane}});
        const SlowCut slow = slowCut(scene.query());
        EXPECT_EQ(clustersOf(cut(scene.query()).lists.image), slow.lists[0]) << "plane " << trial;
        drawn += slow.lists[0].size();
    }
    EXPECT_GT(drawn, 1000U);
}

TEST(Cut, NeighboursInAPageAreOneRange) {
    Random random(38);
    std::size_t joined = 0;
    for (int trial = 0; trial < 50; ++trial) {
        Scene scene(random, sharedModel(), tests::randomResidency(random, sharedModel()));
        scene.volumes.assign(1, {}); // all of space: nothing but the cut parts neighbours
        const std::vector<ClusterRange> ranges = cut(scene.query()).lists.image.ranges;
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            joined += ranges[i].clusterCount - 1;
            if (i == 0 || ranges[i - 1].page != ranges[i].page) continue;
            EXPECT_GT(ranges[i].firstCluster, ranges[i - 1].firstCluster + ranges[i - 1].clusterCount);
        }
    }
    EXPECT_GT(joined, 1000U);
}

TEST(Cut, CutsEveryChainExactlyOnceWhateverIsResident) {
    Random random(32);
    const Chains chains(sharedModel());
    for (int trial = 0; trial < 200; ++trial) {
        Scene scene(random, sharedModel(), tests::randomResidency(random, sharedModel()));
        scene.volumes.assign(1, {}); // all of space, so that nothing is culled away
        const std::set<ClusterId> drawn = clustersOf(cut(scene.query()).lists.image);
        for (int i = 0; i < 200; ++i) {
            const std::vector<ClusterId> chain = chains.randomChain(random);
            const auto count =
                std::count_if(chain.begin(), chain.end(), [&](const ClusterId& id) { return drawn.contains(id); });
            EXPECT_EQ(count, 1) << "view " << trial;
        }
    }
}

TEST(Cut, AsksForTheSamePagesWhateverIsResident) {
    Random random(33);
    for (int trial = 0; trial < 100; ++trial) {
        Scene scene(random, sharedModel(), sharedModel().all);
        const std::set<std::uint32_t> needed = pagesOf(cut(scene.query()).used);
        scene.resident = tests::randomResidency(random, sharedModel());
        while (true) { // bring in what is wanted until nothing is
            const Cut now = cut(scene.query());
            EXPECT_EQ(pagesOf(demand(scene.query())).size(), now.used.size() + now.wanted.size());
            if (now.wanted.empty()) {
                EXPECT_EQ(pagesOf(now.used), needed);
                EXPECT_LE(now.achievedErrorPixels, scene.errorPixels);
                break;
            }
            EXPECT_GT(now.wanted.size(), 0U);
            for (const hierarchy::PageDemand& wanted : now.wanted) {
                EXPECT_TRUE(needed.contains(wanted.page));
                scene.resident[wanted.page] = sharedModel().all[wanted.page];
            }
        }
    }
}

TEST(Cut, TheTableForeseesEveryPageThatIsNeeded) {
    Random random(37);
    std::size_t neededCount = 0;
    std::size_t prefetchCount = 0;
    for (int trial = 0; trial < 50; ++trial) {
        Scene scene(random, sharedModel(), sharedModel().all);
        const std::set<std::uint32_t> needed = pagesOf(cut(scene.query()).used);
        scene.resident = tests::randomResidency(random, sharedModel());
        const Cut now = cut(scene.query());
        const std::vector<hierarchy::PageDemand> demands = findPrefetchSet(scene.query(), now, sharedModel().table);
        const std::set<std::uint32_t> prefetchSet = pagesOf(demands);
        const std::set<std::uint32_t> wanted = pagesOf(now.wanted);
        EXPECT_EQ(prefetchSet.size(), demands.size());
        EXPECT_TRUE(!wanted.empty() || prefetchSet.empty());
        for (const std::uint32_t page : needed)
            EXPECT_EQ((scene.resident[page] != nullptr) + wanted.contains(page) + prefetchSet.contains(page), 1)
                << page;
        for (const std::uint32_t page : prefetchSet) {
            EXPECT_EQ(scene.resident[page], nullptr);
            neededCount += needed.contains(page) ? 1 : 0;
        }
        prefetchCount += prefetchSet.size();
    }
    EXPECT_GT(neededCount, 100U);
    EXPECT_LT(prefetchCount, 3 * neededCount) << "loads much that is not needed";
}

TEST(Cut, ReportsTheErrorOfWhatIsMissing) {
    Random random(34);
    int worse = 0;
    for (int trial = 0; trial < 50; ++trial) {
        Scene scene(random, sharedModel(), tests::randomResidency(random, sharedModel()));
        const Cut now = cut(scene.query());
        double worst = 0;
        for (const ClusterRange& range : now.lists.image.ranges) {
            const hierarchy::Page& page = *scene.resident[range.page];
            for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
                if (page.clusters[c].refinement == kNone) continue;
                const hierarchy::Refinement& finer = page.refinements[page.clusters[c].refinement];
                const double error = tests::largerError(finer);
                const Box box = scene.trees->grid().local(page.clusters[c].box);
                const double pixels = scene.rule.viewPixels(finer.bounds, error);
                const bool isMissing = pixels > scene.errorPixels;
                worst = std::max(worst, isMissing ? std::min(pixels, scene.rule.maxViewPixels(box, error)) : pixels);
            }
        }
        EXPECT_EQ(now.achievedErrorPixels, worst);
        EXPECT_LE(worst, scene.view.heightPixels * (1 + scene.view.tanHalfX / scene.view.tanHalfY));
        worse += worst > scene.errorPixels ? 1 : 0;
    }
    EXPECT_GT(worse, 5);
}

TEST(Cut, NamesRootsThatAreNotResident) {
    Random random(36);
    Scene scene(random, sharedModel(), std::vector<const hierarchy::Page*>(sharedModel().all.size(), nullptr));
    const Cut empty = cut(scene.query());
    EXPECT_EQ(empty.lists.image.triangles, 0U);
    EXPECT_EQ(empty.wanted.size(), sharedModel().rootCount());
    EXPECT_EQ(empty.achievedErrorPixels, std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace gnomon::lod
