// What rays from a frame's surfaces to the light can meet lies in one volume; and which frames have such rays.
#include "core/random.h"
#include "frame/prepared_frame.h"
#include "frame/ray_casters.h"
#include "tests/support/crate_scene.h"
#include "tests/support/drawn_model.h"

#include <gtest/gtest.h>

namespace gnomon::frame {
namespace {

bool isInside(const ConvexVolume& volume, const glm::dvec3& point, double tolerance) {
    return std::all_of(volume.planes.begin(), volume.planes.end(), [&](const Plane& plane) {
        return plane.signedDistance(point) >= -tolerance;
    });
}

TEST(RayCasters, HoldEveryRayFromWhatIsSeenToTheLightAndNotTheOthers) {
    DrawnModel model(crateOnGround().model());
    Random random(1);
    int outside = 0;
    for (int trial = 0; trial < 20; ++trial) {
        plan::View view = overGround();
        view.camera.eye = {random.uniform(-12, 12), random.uniform(2, 10), random.uniform(8, 16)};
        view.towardsLight = {random.uniform(-1, 1), random.uniform(0.2, 1), random.uniform(-1, 1)};
        const PreparedFrame frame = model.renderer().prepare(view, inSlices(1));
        const ConvexVolume casters = rayCasterVolume(frame);
        const lod::CasterDetail detail = rayCasterDetail(frame);
        const glm::dvec3 origin = model.file().summary().grid.origin;
        const plan::SceneFacts::Visible& seen = *frame.facts.visible;
        for (int i = 0; i < 200; ++i) {
            const double depth = random.uniform(seen.nearest, seen.farthest);
            const double x = random.uniform(-1, 1) * depth * view.tanHalfX();
            const double y = random.uniform(-1, 1) * depth * view.tanHalfY();
            const glm::dvec3 surface =
                view.camera.eye + toWorld(frame.plan.basis, {x, y, depth}) - origin; // local space
            EXPECT_TRUE(isInside(detail.receivers, surface, 1e-6)) << trial;
            const glm::dvec3 towardsLight = view.light().unit();
            for (const double way : {0.0, 1.0, 1000.0})
                EXPECT_TRUE(isInside(casters, surface + way * towardsLight, 1e-6 * (1 + way))) << trial;
            outside += isInside(casters, surface - 100.0 * towardsLight, 0) ? 0 : 1;
        }
        EXPECT_EQ(detail.towardsLight, view.light().unit());
        EXPECT_LE(detail.receiverNear, seen.nearest);
    }
    EXPECT_GT(outside, 3000) << "away from the light it ends";
}

TEST(RayCasters, OfAPointLightHoldEveryWayToIt) {
    DrawnModel model(crateOnGround().model());
    Random random(2);
    int outside = 0;
    for (int trial = 0; trial < 20; ++trial) {
        plan::View view = overGround();
        view.camera.eye = {random.uniform(-12, 12), random.uniform(2, 10), random.uniform(8, 16)};
        const double reach = trial % 4 == 0 ? 1000 : 12;
        view.pointLight = {
            {random.uniform(-reach, reach), random.uniform(-1, 1) * reach, random.uniform(-reach, reach)}, 1};
        plan::Quality quality;
        quality.shadows = plan::ShadowMode::Exact;
        const PreparedFrame frame = model.renderer().prepare(view, quality);
        const ConvexVolume casters = rayCasterVolume(frame);
        const std::vector<lod::CasterDetail> details = pointCasterDetails(frame);
        const glm::dvec3 origin = model.file().summary().grid.origin;
        const glm::dvec3 light = view.pointLight->at - origin;
        const plan::SceneFacts::Visible& seen = *frame.facts.visible;
        for (int i = 0; i < 200; ++i) {
            const double depth = random.uniform(seen.nearest, seen.farthest);
            const double x = random.uniform(-1, 1) * depth * view.tanHalfX();
            const double y = random.uniform(-1, 1) * depth * view.tanHalfY();
            const glm::dvec3 surface =
                view.camera.eye + toWorld(frame.plan.basis, {x, y, depth}) - origin; // local space
            const glm::dvec3 between = surface + random.uniform(0, 1) * (light - surface);
            EXPECT_TRUE(isInside(casters, between, 1e-9 * reach)) << trial;
            // Of the slab that the surface lies in: near enough, far enough from the light, and it holds the way.
            EXPECT_TRUE(std::any_of(details.begin(), details.end(), [&](const lod::CasterDetail& detail) {
                return detail.receiverNear <= depth * (1 + 1e-9) && detail.receiverNear > depth / 2.1 &&
                       detail.point->farthest >= glm::length(light - surface) * (1 - 1e-9) &&
                       isInside(detail.casters, between, 1e-9 * reach) &&
                       glm::length(detail.point->at - light) < 1e-9 * reach;
            })) << trial;
            outside += isInside(casters, light + 1.5 * (light - surface), 0) ? 0 : 1;
        }
    }
    EXPECT_GT(outside, 3000) << "behind the light it ends";
}

TEST(PreparedFrame, IsRayTracedWhereRaysAreAskedForAndAnythingIsSeen) {
    PreparedFrame frame;
    EXPECT_FALSE(frame.isRayTraced());
    frame.plan.quality.shadows = plan::ShadowMode::Rays;
    EXPECT_FALSE(frame.isRayTraced()) << "nobody has looked";
    frame.facts.visible = plan::SceneFacts::Visible{1, 2, false};
    EXPECT_FALSE(frame.isRayTraced()) << "nothing is seen";
    frame.facts.visible->anything = true;
    EXPECT_TRUE(frame.isRayTraced());
    frame.plan.quality.shadows = plan::ShadowMode::Maps;
    EXPECT_FALSE(frame.isRayTraced());
}

} // namespace
} // namespace gnomon::frame
