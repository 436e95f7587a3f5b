#include "frame/ray_casters.h"

#include "culling/frame_cut.h"
#include "shadow/caster_volume.h"

#include <algorithm>

namespace gnomon::frame {

namespace {

/// The frustum of all that is drawn, whatever range the shadows are promised for.
shadow::ViewFrustum visibleFrustum(const plan::FramePlan& plan, const plan::SceneFacts& facts) {
    double near = plan.near;
    double far = plan.far;
    if (facts.visible && facts.visible->anything) {
        near = std::min(near, facts.visible->nearest);
        far = std::max(far, facts.visible->farthest);
    }
    constexpr double kLeastRatio = 1e-9; // a frustum wants a near plane
    return {std::max(near, kLeastRatio * far), far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
}

shadow::Region wholeRegion(const plan::FramePlan& plan, const plan::SceneFacts& facts) {
    const shadow::ViewFrustum frustum = visibleFrustum(plan, facts);
    const auto selector =
        shadow::partitionSelector(frustum, plan.towardsLight, {frustum.near, frustum.far}, shadow::FaceMaps::None);
    return shadow::partitionRegion(frustum, selector, 0);
}

} // namespace

ConvexVolume rayCasterVolume(const PreparedFrame& frame) {
    const plan::FramePlan& plan = frame.plan;
    const shadow::Region region = wholeRegion(plan, frame.facts);
    return culling::localVolume(
        shadow::casterVolume(region, shadow::lightFrame(plan.towardsLight)), frame.rule->view());
}

selection::CasterDetail rayCasterDetail(const PreparedFrame& frame) {
    const plan::FramePlan& plan = frame.plan;
    const shadow::Region region = wholeRegion(plan, frame.facts);
    selection::CasterDetail detail; // without texels
    detail.casters = rayCasterVolume(frame);
    detail.receivers = culling::localVolume(region.volume, frame.rule->view());
    detail.receiverNear = region.frustum.near;
    detail.towardsLight = plan.light.unit();
    return detail;
}

} // namespace gnomon::frame
