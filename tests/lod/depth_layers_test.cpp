// Layers of clusters over a pixel, against rays through the boxes.
#include "lod/layers.h"
#include "seen_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace gnomon::lod {
namespace {

constexpr double kFarAway = std::numeric_limits<double>::infinity();

/// Whether a ray from `eye` along `direction` meets `box` anywhere.
bool intersects(const Box& box, const glm::dvec3& eye, const glm::dvec3& direction) {
    double first = 0;
    double last = kFarAway;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.min[axis] - eye[axis]) / direction[axis];
        const double b = (box.max[axis] - eye[axis]) / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last;
}

TEST(Layers, AreAboutAsManyAsRaysMeetAndNeverFarFewer) {
    Random random(17);
    double counted = 0;
    double hit = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const Seen scene(random);
        const double layers = imageLayers(scene.query(), scene.cut.lists.image, kFarAway);
        constexpr int kRays = 40;
        int hits = 0;
        for (int ray = 0; ray < kRays; ++ray) {
            const double x = random.uniform(-1, 1) * scene.view.tanHalfX;
            const double y = random.uniform(-1, 1) * scene.view.tanHalfY;
            const glm::dvec3 direction = toWorld(scene.view.basis, glm::dvec3(x, y, 1));
            forEveryCluster(scene.query(), scene.cut.lists.image, [&](const auto&, const auto& cluster) {
                hits += intersects(scene.query().trees->grid().local(cluster.box), scene.view.eye, direction) ? 1 : 0;
            });
        }
        counted += layers;
        hit += static_cast<double>(hits) / kRays;
    }
    EXPECT_GT(counted, 0.9 * hit); // what lies beside the image counts as well
    EXPECT_LT(counted, 4 * hit);
}

TEST(Layers, AreNotCountedOnceTheyAreEnough) {
    Random random(18);
    int stoppedEarly = 0;
    for (int trial = 0; trial < 30; ++trial) {
        const Seen scene(random);
        const double all = imageLayers(scene.query(), scene.cut.lists.image, kFarAway);
        const double some = imageLayers(scene.query(), scene.cut.lists.image, 0.25 * all);
        EXPECT_GE(some, 0.25 * all);
        EXPECT_LE(some, all);
        EXPECT_EQ(imageLayers(scene.query(), {}, 1), 0);
        stoppedEarly += some < all ? 1 : 0;
    }
    EXPECT_GT(stoppedEarly, 10);
}

} // namespace
} // namespace gnomon::lod
