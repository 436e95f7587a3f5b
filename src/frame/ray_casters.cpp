#include "frame/ray_casters.h"

#include "lod/frame_cut.h"
#include "shadow/caster_volume.h"

#include <algorithm>

namespace gnomon::frame {

namespace {

/// Returns the frustum that contains all visible surfaces, also surfaces outside the depth range with an aliasing
/// bound.
shadow::ViewFrustum visibleFrustum(const plan::FramePlan& plan, const plan::SceneFacts& facts) {
    double near = plan.near;
    double far = plan.far;
    if (facts.visible && facts.visible->anything) {
        near = std::min(near, facts.visible->nearest);
        far = std::max(far, facts.visible->farthest);
    }
    constexpr double kMinRatio = 1e-9; // min near / far; a frustum needs a near plane
    return {std::max(near, kMinRatio * far), far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
}

shadow::Region wholeRegion(const plan::FramePlan& plan, const plan::SceneFacts& facts) {
    const shadow::ViewFrustum frustum = visibleFrustum(plan, facts);
    const auto selector =
        shadow::partitionSelector(frustum, plan.towardsLight, {frustum.near, frustum.far}, shadow::FaceMaps::None);
    return shadow::partitionRegion(frustum, selector, 0);
}

/// Returns the corners of the part of the view frustum between the depths `near` and `far`, in camera space.
std::vector<glm::dvec3> cornersBetween(const plan::View& view, double near, double far) {
    std::vector<glm::dvec3> corners;
    for (const double depth : {near, far})
        for (const double x : {-1.0, 1.0})
            for (const double y : {-1.0, 1.0})
                corners.push_back(depth * glm::dvec3(x * view.tanHalfX(), y * view.tanHalfY(), 1));
    return corners;
}

/// Returns the position of the view's point light in camera space.
glm::dvec3 pointInCamera(const plan::FramePlan& plan) {
    return toCamera(plan.basis, plan.view.pointLight->at - plan.view.camera.eye);
}

/// Returns the level of detail that the casters between a point light and the visible points at depths from `near` to
/// `far` require.
lod::CasterDetail slabDetail(const PreparedFrame& frame, double near, double far) {
    const plan::FramePlan& plan = frame.plan;
    const std::vector<glm::dvec3> corners = cornersBetween(plan.view, near, far);
    const glm::dvec3 light = pointInCamera(plan);
    lod::CasterDetail detail;
    detail.casters = lod::localVolume(shadow::pointCasterVolume(corners, light), frame.rule->view());
    detail.receiverNear = near;
    detail.point.emplace();
    detail.point->at = frame.rule->view().eye + (plan.view.pointLight->at - plan.view.camera.eye);
    for (const glm::dvec3& corner : corners)
        detail.point->farthest = std::max(detail.point->farthest, glm::length(corner - light));
    return detail;
}

} // namespace

ConvexVolume rayCasterVolume(const PreparedFrame& frame) {
    const plan::FramePlan& plan = frame.plan;
    if (plan.view.pointLight) {
        const shadow::ViewFrustum frustum = visibleFrustum(plan, frame.facts);
        return slabDetail(frame, frustum.near, frustum.far).casters;
    }
    const shadow::Region region = wholeRegion(plan, frame.facts);
    return lod::localVolume(shadow::casterVolume(region, shadow::lightFrame(plan.towardsLight)), frame.rule->view());
}

lod::CasterDetail rayCasterDetail(const PreparedFrame& frame) {
    const plan::FramePlan& plan = frame.plan;
    const shadow::Region region = wholeRegion(plan, frame.facts);
    lod::CasterDetail detail; // the default texel size is 0, because rays have no texels
    detail.casters = rayCasterVolume(frame);
    detail.receivers = lod::localVolume(region.volume, frame.rule->view());
    detail.receiverNear = region.frustum.near;
    detail.towardsLight = plan.light.unit();
    return detail;
}

std::vector<lod::CasterDetail> pointCasterDetails(const PreparedFrame& frame) {
    constexpr int kMaxSlabs = 12;
    const shadow::ViewFrustum frustum = visibleFrustum(frame.plan, frame.facts);
    std::vector<lod::CasterDetail> details;
    double far = frustum.far;
    while (static_cast<int>(details.size()) + 1 < kMaxSlabs && far / 2 > frustum.near) {
        details.push_back(slabDetail(frame, far / 2, far));
        far /= 2;
    }
    details.push_back(slabDetail(frame, frustum.near, far));
    return details;
}

} // namespace gnomon::frame
