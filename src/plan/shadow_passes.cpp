#include "plan/shadow_passes.h"

#include "shadow/light_fit.h"
#include "shadow/warped_map.h"

#include <array>

namespace gnomon::plan {

namespace {

/// The half-space of camera points where dot(row, (p, 1)) is not negative.
Plane halfSpace(const glm::dvec4& row) {
    const double length = glm::length(glm::dvec3(row));
    return {glm::dvec3(row) / length, row.w / length};
}

/// All that the map shows and all that lies between that and the light: no near plane.
ConvexVolume mapVolume(const glm::dmat4& textureFromCamera, const glm::dvec2& gutter) {
    const glm::dmat4 rows = glm::transpose(textureFromCamera);
    const auto [s, t, depth, w] = std::array{rows[0], rows[1], rows[2], rows[3]};
    return {
        {halfSpace(s + w * gutter.x),
         halfSpace(w * (1 + gutter.x) - s),
         halfSpace(t + w * gutter.y),
         halfSpace(w * (1 + gutter.y) - t),
         halfSpace(w - depth)}};
}

ConvexVolume frustumVolume(const shadow::ViewFrustum& frustum) {
    using shadow::Face;
    ConvexVolume volume{{{{0, 0, 1}, -frustum.near}, {{0, 0, -1}, frustum.far}}};
    for (const Face side : {Face::Top, Face::Bottom, Face::Left, Face::Right})
        volume.planes.push_back({-shadow::outwardNormal(frustum, side), 0});
    return volume;
}

} // namespace

void planShadowPasses(FramePlan& plan) {
    const Quality& quality = plan.quality;
    const shadow::ViewFrustum frustum{plan.near, plan.far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
    const shadow::LightFit fit = shadow::fitSlice(shadow::lightFrame(plan.towardsLight), frustum);
    ShadowPass pass;
    pass.near = frustum.near;
    pass.far = frustum.far;
    const double kappa = shadow::kappaOf(quality.warp, fit);
    pass.warp = shadow::warpedMap(fit, kappa, 1e-3 * frustum.far);
    pass.textureFromCamera = shadow::textureFromCamera(pass.warp);
    pass.receivers = frustumVolume(frustum);
    const int gutter = (std::max(quality.filter, 1) + 1) / 2 + 1;
    plan.textureWidth = quality.shadowTexelsWidth;
    plan.textureHeight = quality.shadowTexelsHeight;
    pass.rectangle = {0, 0, plan.textureWidth, plan.textureHeight};
    pass.map = {gutter, gutter, plan.textureWidth - 2 * gutter, plan.textureHeight - 2 * gutter};
    const shadow::Aliasing unit = shadow::worstAliasing(fit, kappa);
    pass.promised = {unit.x * plan.view.height / pass.map.width, unit.z * plan.view.height / pass.map.height};
    pass.casters = mapVolume(
        pass.textureFromCamera,
        {static_cast<double>(gutter) / pass.map.width, static_cast<double>(gutter) / pass.map.height});
    plan.splits = {frustum.near, frustum.far};
    plan.promised = pass.promised;
    plan.storageFactor = unit.x * unit.z;
    plan.passes = {pass};
}

} // namespace gnomon::plan
