// All cores make the cut that one makes, and camera space is turned into local space rightly.
#include "lod/caster_detail.h"
#include "lod/frame_cut.h"
#include "tests/support/model_views.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::lod {
namespace {

using tests::sharedModel;

bool sameDemand(const std::vector<hierarchy::PageDemand>& a, const std::vector<hierarchy::PageDemand>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
        return x.page == y.page && x.pixels == y.pixels;
    });
}

TEST(FrameCut, IsTheCutOfOneThread) {
    Random random(51);
    for (int trial = 0; trial < 60; ++trial) {
        const lod::DetailView view = tests::randomView(random, sharedModel().bounds);
        const std::vector<lod::CasterDetail> casters = tests::randomCasters(random, view);
        const lod::ErrorRule rule(view, casters);
        std::vector<ConvexVolume> volumes{lod::viewPyramid(view)};
        for (const lod::CasterDetail& caster : casters)
            volumes.push_back(caster.casters);
        const std::vector<const hierarchy::Page*> resident = tests::randomResidency(random, sharedModel());
        const lod::CutQuery query{&sharedModel().trees, resident, &rule, std::exp(random.uniform(-5, 1)), volumes};
        const lod::Cut one = lod::cut(query);
        const lod::Cut all = cutFrame(query);
        EXPECT_TRUE(one.lists == all.lists);
        EXPECT_TRUE(sameDemand(one.used, all.used));
        EXPECT_TRUE(sameDemand(one.wanted, all.wanted));
        EXPECT_EQ(one.achievedErrorPixels, all.achievedErrorPixels);
    }
}

TEST(FrameCut, CameraVolumesHoldTheSamePointsInLocalSpace) {
    Random random(52);
    for (int trial = 0; trial < 1000; ++trial) {
        const lod::DetailView view = tests::randomView(random, sharedModel().bounds);
        ConvexVolume inCamera;
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 normal(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            inCamera.planes.push_back({glm::normalize(normal + glm::dvec3(1e-9)), random.uniform(-1, 5)});
        }
        const ConvexVolume local = localVolume(inCamera, view);
        const glm::dvec3 point =
            view.eye + glm::dvec3(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9));
        const glm::dvec3 seen = toCamera(view.basis, point - view.eye);
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_NEAR(local.planes[i].signedDistance(point), inCamera.planes[i].signedDistance(seen), 1e-9);
    }
}

// The rule's texel is the one that the map's own light beam has.
TEST(CasterDetail, TexelsAreThoseOfTheMap) {
    Random random(53);
    for (int trial = 0; trial < 1000; ++trial) {
        const lod::DetailView view = tests::randomView(random, sharedModel().bounds);
        shadow::ShadowMap map;
        const glm::dvec3 light(random.uniform(-1, 1), random.uniform(0.2, 1), random.uniform(-1, 1));
        map.warped.frame = shadow::lightFrame(glm::normalize(light));
        map.warped.kappa = random.uniform(0.01, 3);
        map.warped.rows = random.below(2) == 0 ? shadow::RowSpacing::Even : shadow::RowSpacing::Logarithmic;
        map.warped.zMin = random.uniform(-2, 2);
        map.warped.length = random.uniform(1, 50);
        map.warped.width = random.uniform(1, 50);
        const auto side = [&] { return static_cast<int>(64 + random.below(4000)); };
        map.rectangle = {side(), side(), side(), side(), random.below(2) == 0};
        map.gutter = 1 + static_cast<int>(random.below(3));
        const lod::CasterDetail detail = casterDetail(view, map);
        const double zeta = random.unit() * map.warped.length;
        const glm::dvec3 inLight(random.uniform(-9, 9), random.uniform(-9, 9), map.warped.zMin + zeta);
        const glm::dvec3 inCamera = shadow::toCamera(map.warped.frame, inLight);
        const glm::dvec3 point = view.eye + toWorld(view.basis, inCamera);
        const shadow::LightBeam beam = shadow::lightBeam(map.warped, inCamera, map.texels());
        const double found = glm::dot(detail.texel.axis, point) - detail.texel.origin;
        EXPECT_NEAR(found, zeta, 1e-9);
        EXPECT_NEAR(detail.texel.smallerSide(found), std::min(beam.x, beam.z), 1e-9);
        const glm::dvec3 up = toCamera(view.basis, detail.towardsLight);
        EXPECT_NEAR(glm::distance(up, map.warped.frame.y), 0, 1e-12);
    }
}

} // namespace
} // namespace gnomon::lod
