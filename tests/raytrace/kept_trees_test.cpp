// Trees that are kept by page against one scene of the same triangles, made anew.
#include "core/random.h"
#include "raytrace/kept_trees.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <set>

namespace gnomon::raytrace {
namespace {

using Clusters = std::vector<PageClusters>;

const tests::TinyModel& model() {
    static const tests::TinyModel model = [] {
        tests::TinyModelOptions options;
        options.gridExponent = 6;
        options.height = 12;
        return tests::makeTinyModel(options);
    }();
    return model;
}

/// Those clusters of all levels that `isDrawn` picks, by page and cluster.
template <class Pick>
Clusters picked(const Pick& isDrawn) {
    Clusters clusters;
    for (std::uint32_t p = 0; p < model().pages.size(); ++p)
        for (std::uint32_t c = 0; c < model().pages[p].clusters.size(); ++c)
            if (isDrawn(p, c)) clusters.push_back({p, {&model().pages[p], c, 1}});
    return clusters;
}

Clusters finestLevel() {
    return picked([](std::uint32_t p, std::uint32_t) { return model().pages[p].level == 0; });
}

/// One scene of `clusters`.
Scene plainScene(const Clusters& clusters, const hierarchy::GridPoint& origin) {
    std::vector<ClusterSpan> spans;
    for (const PageClusters& each : clusters)
        spans.push_back(each.span);
    return {spans, model().summary.grid, model().summary.grid.local(origin)};
}

/// A point in the middle of the model, where camera-relative space might begin.
hierarchy::GridPoint middle() {
    const hierarchy::GridPoint max = model().pages.front().clusters.front().box.max;
    return {max.x / 2, max.y, max.z / 2};
}

/// Rays in world units from `origin`, from over, amid and under the hills in all directions.
std::vector<Ray> someRays(std::uint64_t seed, const hierarchy::GridPoint& origin) {
    const glm::dvec3 start = model().summary.grid.local(origin);
    Random random(seed);
    std::vector<Ray> rays;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 from(random.uniform(-5, 69), random.uniform(-2, 14), random.uniform(-5, 69));
        const glm::dvec3 along(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        rays.push_back({glm::vec3(from - start), glm::vec3(glm::normalize(along)), 0.01F});
    }
    return rays;
}

/// Asks both about rays, of which some hit and some do not.
void expectTheSame(const Occluders& kept, const Occluders& plain, std::uint64_t seed) {
    int differing = 0;
    int occluded = 0;
    for (const Ray& ray : someRays(seed, middle())) {
        const bool isOccluded = plain.isOccluded(ray);
        occluded += isOccluded ? 1 : 0;
        differing += kept.isOccluded(ray) == isOccluded ? 0 : 1;
    }
    EXPECT_LE(differing, 1); // other roundings at an edge
    EXPECT_GT(occluded, 100);
    EXPECT_LT(occluded, 2900);
}

TEST(CutScene, MeetsWhatOneSceneMeets) {
    KeptTrees trees;
    const CutScene kept(trees, finestLevel(), model().summary.grid, middle());
    expectTheSame(kept, plainScene(finestLevel(), middle()), 81);
}

// A run has one tree, whichever of its clusters are drawn; what the last frame drew of it is forgotten.
TEST(CutScene, MeetsNoClusterThatIsNotDrawn) {
    KeptTrees trees;
    for (std::uint32_t third = 0; third < 3; ++third) {
        SCOPED_TRACE(third);
        Clusters some = picked([&](std::uint32_t p, std::uint32_t c) { return (p + c) % 3 == third; });
        some.push_back(some.front()); // twice is once
        const CutScene kept(trees, some, model().summary.grid, middle());
        expectTheSame(kept, plainScene(some, middle()), 82 + third);
    }
}

TEST(CutScene, OfNothingStopsNothing) {
    KeptTrees trees;
    const CutScene kept(trees, {}, model().summary.grid, middle());
    for (const Ray& ray : someRays(85, middle()))
        EXPECT_FALSE(kept.isOccluded(ray));
}

TEST(CutScene, IsTheSameWithAnyThreads) {
    std::vector<std::vector<bool>> found;
    for (const int threads : {1, 2})
        tbb::task_arena(threads).execute([&] {
            KeptTrees trees;
            const CutScene kept(trees, finestLevel(), model().summary.grid, middle());
            found.emplace_back();
            for (const Ray& ray : someRays(86, middle()))
                found.back().push_back(kept.isOccluded(ray));
        });
    EXPECT_EQ(found[0], found[1]);
}

/// Lets stop the triangles of one cluster alone, and notes what it is asked.
class OneCluster final : public HitRule {
public:
    OneCluster(std::uint32_t page, std::uint32_t cluster) : page_(page), cluster_(cluster) {}

    bool stops(std::uint32_t ray, const PageTriangle& triangle) const override {
        EXPECT_EQ(ray, asked);
        EXPECT_LT(triangle.triangle, model().pages[triangle.page].clusters[triangle.cluster].triangleCount);
        return triangle.page == page_ && triangle.cluster == cluster_;
    }

    std::uint32_t asked = 0; // the name of the ray

private:
    std::uint32_t page_;
    std::uint32_t cluster_;
};

TEST(CutScene, LetsARulePassWhatItWill) {
    KeptTrees trees;
    const Clusters all = finestLevel();
    const CutScene kept(trees, all, model().summary.grid, middle());
    const auto step = static_cast<float>(model().summary.grid.step());
    std::size_t stopped = 0;
    for (std::size_t i = 0; i < all.size(); i += 7) {
        OneCluster rule(all[i].page, all[i].span.firstCluster);
        const Scene plain = plainScene({all[i]}, middle());
        int differing = 0;
        for (const Ray& ray : someRays(87, middle())) {
            Ray inCells = ray;
            inCells.origin /= step;
            inCells.tMin /= step;
            const bool isStopped = kept.isStopped(inCells, ++rule.asked, rule);
            differing += isStopped == plain.isOccluded(ray) ? 0 : 1;
            stopped += isStopped ? 1 : 0;
        }
        EXPECT_LE(differing, 1);
    }
    EXPECT_GT(stopped, 100U);
}

TEST(KeptTrees, ArePaidForOnceAndGoWithTheirPage) {
    KeptTrees trees;
    const std::uint64_t before = trees.bytes().count;
    std::uint64_t max = 0;
    std::set<std::uint32_t> pages;
    for (const PageClusters& each : finestLevel())
        pages.insert(each.page);
    for (const std::uint32_t page : pages) {
        hierarchy::PageInfo info;
        for (const hierarchy::Cluster& cluster : model().pages[page].clusters)
            info.triangleCount += cluster.triangleCount;
        info.clusterCount = static_cast<std::uint32_t>(model().pages[page].clusters.size());
        max += keptTreeBytes(info).count;
    }
    std::uint64_t after = 0;
    for (int frame = 0; frame < 3; ++frame) {
        { const CutScene kept(trees, finestLevel(), model().summary.grid, middle()); }
        if (frame == 0) after = trees.bytes().count;
        EXPECT_EQ(trees.bytes().count, after) << "a tree was made again";
    }
    EXPECT_GT(after, before);
    EXPECT_LE(after - before, max);
    trees.drop(*pages.begin());
    EXPECT_LT(trees.bytes().count, after);
    trees.drop(*pages.begin()); // there is none: nothing happens
    const CutScene again(trees, finestLevel(), model().summary.grid, middle());
    expectTheSame(again, plainScene(finestLevel(), middle()), 88);
}

// A million cells from the origin of the grid, rays from nearby meet what they meet at the origin.
TEST(KeptTrees, LoseNothingFarFromTheOrigin) {
    tests::TinyModel moved = model();
    constexpr std::uint32_t kFar = 1U << 30U;
    const auto move = [](hierarchy::GridPoint& p) { p.x += kFar, p.z += kFar; };
    for (hierarchy::Page& page : moved.pages) {
        for (hierarchy::Vertex& vertex : page.vertices)
            move(vertex.position);
        for (hierarchy::Cluster& cluster : page.clusters)
            move(cluster.box.min), move(cluster.box.max);
    }
    Clusters clusters = finestLevel();
    for (PageClusters& each : clusters)
        each.span.page = &moved.pages[each.page];
    hierarchy::GridPoint origin = middle();
    move(origin);
    KeptTrees trees;
    KeptTrees movedTrees;
    const CutScene here(trees, finestLevel(), model().summary.grid, middle());
    const CutScene there(movedTrees, clusters, model().summary.grid, origin);
    for (const Ray& ray : someRays(89, middle()))
        EXPECT_EQ(here.isOccluded(ray), there.isOccluded(ray));
}

} // namespace
} // namespace gnomon::raytrace
