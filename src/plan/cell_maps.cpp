#include "plan/cell_maps.h"

#include "shadow/setup.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

int cellSide(const FramePlan& plan) {
    const double maps = std::max<double>(1, static_cast<double>(plan.sampleGridMaps.size()));
    return static_cast<int>(kCellSide / std::sqrt(maps));
}

std::vector<shadow::ShadowMap> sampleGridMaps(const FramePlan& plan) {
    shadow::ShadowView view;
    view.frustum = {plan.near, plan.far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
    view.towardsLight = plan.towardsLight;
    view.imageHeight = plan.view.height;
    view.anchor = {plan.basis, plan.view.camera.eye};
    shadow::ShadowOptions options;
    const CellScheme scheme = plan.quality.cellScheme;
    const bool isWarped =
        !plan.view.camera.isParallel() && (scheme == CellScheme::WarpedMap || scheme == CellScheme::WarpedSlices);
    const bool isSliced = scheme == CellScheme::Slices || scheme == CellScheme::WarpedSlices;
    options.scheme.slices = isSliced ? 4 : 1;
    options.scheme.warp.rule = isWarped ? shadow::WarpRule::Lspsm : shadow::WarpRule::None;
    options.texels = std::uint64_t{kCellSide} * kCellSide;
    return shadow::shadowMapSetup(view, options).maps;
}

} // namespace gnomon::plan
