#include "core/convex_volume.h"
#include "core/random.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

glm::dvec3 randomPoint(Random& random) {
    return {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
}

// The sampled truth beside the plane test: a box whose sample points are inside may not be called outside.
TEST(ConvexVolume, ClassificationIsConservative) {
    Random random(7);
    for (int trial = 0; trial < 2000; ++trial) {
        ConvexVolume volume;
        for (int i = 0; i < 5; ++i) {
            const glm::dvec3 normal = glm::normalize(randomPoint(random) + glm::dvec3(1e-9));
            volume.planes.push_back({normal, random.uniform(-0.5, 1.5)});
        }
        Box box;
        box.add(randomPoint(random));
        box.add(randomPoint(random));
        const Containment answer = classify(volume, box);
        for (int sample = 0; sample < 20; ++sample) {
            const glm::dvec3 t(random.unit(), random.unit(), random.unit());
            const bool inside = contains(volume, glm::mix(box.min, box.max, t));
            EXPECT_FALSE(inside && answer == Containment::Outside);
            EXPECT_FALSE(!inside && answer == Containment::Inside);
        }
    }
}

} // namespace
} // namespace gnomon
