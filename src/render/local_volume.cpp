#include "render/local_volume.h"

#include "render/frame_block.h"

#include <algorithm>

namespace gnomon::render {

ConvexVolume toLocal(const CameraBasis& basis, const glm::dvec3& eye, const ConvexVolume& volume) {
    ConvexVolume result;
    for (const Plane& plane : volume.planes) {
        const glm::dvec3 normal = toWorld(basis, plane.normal);
        result.planes.push_back({normal, plane.offset - glm::dot(normal, eye)});
    }
    return result;
}

selection::DetailView detailView(const plan::FramePlan& plan, const glm::dvec3& eye) {
    selection::DetailView view;
    view.eye = eye;
    view.basis = plan.basis;
    view.tanHalfX = plan.view.tanHalfX();
    view.tanHalfY = plan.view.tanHalfY();
    view.heightPixels = plan.view.height;
    return view;
}

selection::CasterDetail casterDetail(const plan::FramePlan& plan, const plan::ShadowPass& pass, const glm::dvec3& eye) {
    selection::CasterDetail detail;
    detail.casters = toLocal(plan.basis, eye, pass.casters);
    detail.receivers = toLocal(plan.basis, eye, pass.receivers);
    detail.receiverNear = pass.near;
    detail.towardsLight = toWorld(plan.basis, plan.towardsLight);
    detail.texel.axis = toWorld(plan.basis, pass.warp.frame.z);
    detail.texel.origin = pass.warp.zMin + glm::dot(detail.texel.axis, eye);
    detail.texel.depth = pass.warp.length;
    detail.texel.kappa = pass.warp.kappa;
    const shadow::Resolution texels = texelsOf(pass);
    detail.texel.width = pass.warp.width / texels.s;
    detail.texel.length = pass.warp.length / texels.t;
    return detail;
}

} // namespace gnomon::render
