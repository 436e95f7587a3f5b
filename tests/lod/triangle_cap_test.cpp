// The error that keeps a frame within its triangles, against counting what every threshold draws.
#include "tests/support/model_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::lod {
namespace {

using hierarchy::kNone;
using tests::ModelInMemory;
using tests::sharedModel;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// A cluster in view and the thresholds from which and up to which it is drawn.
struct Drawn {
    double from = 0;
    double to = 0;
    std::uint64_t triangles = 0;
};

/// A view of the whole model from outside, so that it has hundreds of clusters to choose from.
DetailView wideView(Random& random, const Box& bounds) {
    Camera camera;
    const double angle = random.uniform(0, 6.28);
    camera.target = bounds.center();
    camera.eye = bounds.center() + glm::dvec3(std::cos(angle), random.uniform(0.2, 1), std::sin(angle)) *
                                       (random.uniform(0.4, 0.9) * glm::length(bounds.extent()));
    DetailView view;
    view.eye = camera.eye;
    view.basis = cameraBasis(camera);
    view.nearestDepth = 0.1;
    return view;
}

struct CapScene {
    explicit CapScene(Random& random)
        : view(wideView(random, sharedModel().bounds)),
          rule(view),
          volumes{viewPyramid(view)},
          resident(sharedModel().all) {}

    CutQuery query() const { return {&sharedModel().trees, resident, &rule, errorPixels, volumes, &blocked}; }

    std::uint64_t trianglesAt(double pixels) const {
        CutQuery at = query();
        at.errorPixels = pixels;
        return cut(at).lists.image.triangles;
    }

    DetailView view;
    ErrorRule rule;
    std::vector<ConvexVolume> volumes;
    std::vector<const hierarchy::Page*> resident;
    hierarchy::BlockedGroups blocked;
    double errorPixels = 0.05;
};

/// When a cluster of a group that may be refined is drawn.
Drawn drawnOf(
    const CapScene& scene,
    const hierarchy::Page& page,
    const hierarchy::Group& group,
    const hierarchy::Cluster& cluster) {
    Drawn drawn{0, scene.rule.pixels(group.bounds, tests::largerError(group)), cluster.triangleCount};
    if (cluster.refinement == kNone) return drawn;
    const hierarchy::Refinement& finer = page.refinements[cluster.refinement];
    const bool canBe = scene.resident[finer.group.page] != nullptr && !scene.blocked.contains(finer.group);
    drawn.from = canBe ? scene.rule.pixels(finer.bounds, tests::largerError(finer)) : 0;
    return drawn;
}

/// Every cluster of every resident page, no tree: when it is drawn, if its box is in view.
std::vector<Drawn> allDrawn(const CapScene& scene) {
    std::vector<Drawn> result;
    for (std::uint32_t p = 0; p < scene.resident.size(); ++p) {
        const hierarchy::Page* page = scene.resident[p];
        for (std::uint32_t g = 0; page != nullptr && g < page->groups.size(); ++g) {
            const hierarchy::Group& group = page->groups[g];
            if (scene.blocked.contains({p, g})) continue;
            for (const hierarchy::Cluster& cluster :
                 std::span(page->clusters).subspan(group.firstCluster, group.clusterCount))
                if (classify(scene.volumes[0], sharedModel().trees.grid().local(cluster.box)) != Containment::Outside)
                    result.push_back(drawnOf(scene, *page, group, cluster));
        }
    }
    return result;
}

std::uint64_t countAt(std::span<const Drawn> clusters, double pixels) {
    std::uint64_t count = 0;
    for (const Drawn& drawn : clusters)
        if (drawn.from <= pixels && drawn.to > pixels) count += drawn.triangles;
    return count;
}

/// Where what is drawn changes: the thresholds above `min`, ascending, `min` itself first.
std::vector<double> stepsFrom(std::span<const Drawn> clusters, double min) {
    std::vector<double> steps{min};
    for (const Drawn& drawn : clusters)
        for (const double pixels : {drawn.from, drawn.to})
            if (pixels > min && pixels < kNoLimit) steps.push_back(pixels);
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    return steps;
}

/// What a capped error must be, given the truth at every step: small enough to be drawn within the cap, and a
/// thousandth lower it is either too much or what was asked for.
void checkCap(const CapScene& scene, std::span<const Drawn> clusters, std::uint64_t cap) {
    const double found = cappedErrorPixels(scene.query(), cap);
    const std::uint64_t finest = countAt(clusters, scene.errorPixels);
    const std::uint64_t kept = scene.trianglesAt(found);
    EXPECT_EQ(kept, countAt(clusters, found)) << "the test's own count is that of the cut";
    if (finest <= cap) {
        EXPECT_EQ(found, scene.errorPixels) << "what fits is left as it is";
        return;
    }
    const std::vector<double> steps = stepsFrom(clusters, scene.errorPixels);
    const std::uint64_t coarsest = countAt(clusters, steps.back());
    EXPECT_LE(found, steps.back() * 1.001);
    if (kept > cap) {
        EXPECT_EQ(kept, coarsest) << "where nothing fits the coarsest is drawn";
        return;
    }
    EXPECT_GT(countAt(clusters, found / 1.0011), cap) << "a lower error would have done";
}

TEST(TriangleCap, IsKeptByTheLeastErrorThatKeepsIt) {
    Random random(35);
    for (int trial = 0; trial < 12; ++trial) {
        const CapScene scene(random);
        const std::vector<Drawn> clusters = allDrawn(scene);
        const std::uint64_t finest = countAt(clusters, scene.errorPixels);
        const std::uint64_t coarsest = countAt(clusters, 1e30);
        ASSERT_GT(finest, 20 * coarsest) << "there is something to choose from";
        for (const std::uint64_t cap :
             {std::uint64_t{0}, coarsest - 1, coarsest, coarsest + 1, finest - 1, finest, finest + 1})
            checkCap(scene, clusters, cap);
        for (int i = 0; i < 6; ++i)
            checkCap(scene, clusters, coarsest + random.below(finest - coarsest));
    }
}

// A cap that only the coarsest cut keeps is kept by doing nothing, too; a good one is nearly used up.
TEST(TriangleCap, IsNearlyUsedUp) {
    Random random(36);
    double used = 0;
    int count = 0;
    for (int trial = 0; trial < 12; ++trial) {
        const CapScene scene(random);
        const std::uint64_t finest = scene.trianglesAt(scene.errorPixels);
        for (const double share : {0.2, 0.5, 0.8}) {
            const auto cap = static_cast<std::uint64_t>(share * static_cast<double>(finest));
            const std::uint64_t kept = scene.trianglesAt(cappedErrorPixels(scene.query(), cap));
            EXPECT_GE(static_cast<double>(kept), 0.8 * static_cast<double>(cap)) << trial << " at " << share;
            used += static_cast<double>(kept) / static_cast<double>(cap);
            ++count;
        }
    }
    EXPECT_GT(used / count, 0.95);
}

TEST(TriangleCap, CountsWhatResidencyAndDamageLeaveToBeDrawn) {
    Random random(37);
    for (int trial = 0; trial < 12; ++trial) {
        CapScene scene(random);
        scene.resident = tests::randomResidency(random, sharedModel());
        for (std::uint32_t p = 0; p < scene.resident.size(); ++p)
            if (sharedModel().all[p]->level == 1 && random.below(4) == 0) scene.blocked.insert({p, 0});
        // What is blocked has nothing below it that is drawn.
        for (std::uint32_t p = 0; p < scene.resident.size(); ++p)
            for (const hierarchy::Refinement& finer : sharedModel().all[p]->refinements)
                if (scene.blocked.contains({p, 0})) scene.blocked.insert(finer.group);
        const std::vector<Drawn> clusters = allDrawn(scene);
        const std::uint64_t finest = countAt(clusters, scene.errorPixels);
        for (int i = 0; i < 4; ++i)
            checkCap(scene, clusters, 1 + random.below(finest));
    }
}

TEST(TriangleCap, OfAnErrorOfZeroStillFindsOne) {
    Random random(38);
    CapScene scene(random);
    scene.errorPixels = 0;
    const std::vector<Drawn> clusters = allDrawn(scene);
    const std::uint64_t finest = countAt(clusters, 0);
    EXPECT_EQ(cappedErrorPixels(scene.query(), finest), 0);
    const double found = cappedErrorPixels(scene.query(), finest / 2);
    EXPECT_GT(found, 0);
    EXPECT_LE(countAt(clusters, found), finest / 2);
    EXPECT_GT(countAt(clusters, found / 1.0011), finest / 2);
}

} // namespace
} // namespace gnomon::lod
