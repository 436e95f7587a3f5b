#include "plan/cell_maps.h"

#include "shadow/setup.h"

namespace gnomon::plan {

std::vector<shadow::ShadowMap> cellMaps(const FramePlan& plan) {
    shadow::ShadowView view;
    view.frustum = {plan.near, plan.far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
    view.towardsLight = plan.towardsLight;
    view.imageHeight = plan.view.height;
    view.anchor = {plan.basis, plan.view.camera.eye};
    shadow::ShadowOptions options;
    options.scheme.slices = 1;
    options.scheme.warp.rule = shadow::WarpRule::Lspsm;
    options.texels = std::uint64_t{kCellSide} * kCellSide;
    return shadow::shadowMapSetup(view, options).maps;
}

} // namespace gnomon::plan
