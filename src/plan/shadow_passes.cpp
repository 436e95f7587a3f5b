#include "plan/shadow_passes.h"

#include "shadow/setup.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

namespace {

shadow::ShadowOptions optionsOf(const Quality& quality) {
    shadow::ShadowOptions options;
    options.scheme.warp = quality.warp;
    options.scheme.slices = quality.zPartitions.value_or(4);
    options.scheme.splitLambda = quality.splitLambda;
    options.scheme.faces = quality.facePartitions == Choice::On;
    options.stabilized = quality.stabilize;
    options.filterTexels = quality.filter;
    options.texels =
        static_cast<std::uint64_t>(quality.shadowTexelsWidth) * static_cast<std::uint64_t>(quality.shadowTexelsHeight);
    return options;
}

/// What a lookup reads of `partition`: its rectangle without the gutter on each side.
Rectangle withoutGutter(const shadow::TexelRectangle& r, int gutter) {
    return {r.x + gutter, r.y + gutter, r.width - 2 * gutter, r.height - 2 * gutter};
}

ShadowPass passOf(const shadow::ShadowMapPartition& partition, const shadow::ShadowMapSetup& setup) {
    ShadowPass pass;
    pass.slice = static_cast<int>(partition.region.slice);
    pass.face = partition.region.face;
    pass.near = partition.region.frustum.near;
    pass.far = partition.region.frustum.far;
    pass.warp = partition.map;
    const shadow::TexelRectangle& r = partition.rectangle;
    pass.rectangle = {r.x, r.y, r.width, r.height};
    pass.map = withoutGutter(r, setup.gutter);
    const glm::dmat4 texelFromTexture =
        glm::transpose(glm::dmat4(setup.textureWidth, 0, 0, 0, 0, setup.textureHeight, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1));
    pass.texelFromCamera = texelFromTexture * partition.textureFromCamera;
    pass.promised = {partition.promised.x, partition.promised.z};
    pass.casters = partition.casterVolume;
    pass.receivers = partition.region.volume;
    return pass;
}

} // namespace

void planShadowPasses(FramePlan& plan, const FramePlan* previous) {
    shadow::ShadowView view;
    view.frustum = {plan.near, plan.far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
    view.towardsLight = plan.towardsLight;
    view.imageHeight = plan.view.height;
    const shadow::ShadowOptions options = optionsOf(plan.quality);
    const auto orientation = previous != nullptr ? previous->orientation : std::nullopt;
    const shadow::ShadowMapSetup setup = shadow::shadowMapSetup(view, options, orientation);
    plan.selector = setup.selector;
    plan.splits = setup.selector.splits;
    plan.hasFaces = !setup.selector.faces.empty();
    plan.orientation = setup.orientation;
    plan.textureWidth = setup.textureWidth;
    plan.textureHeight = setup.textureHeight;
    for (const std::size_t map : setup.mapOfPartition)
        plan.passOfPartition.push_back(map == shadow::ShadowMapSetup::kNoMap ? -1 : static_cast<int>(map));
    plan.storageFactor = 0;
    for (const shadow::ShadowMapPartition& partition : setup.maps) {
        plan.passes.push_back(passOf(partition, setup));
        const ShadowPass& pass = plan.passes.back();
        const double scaleX = static_cast<double>(pass.map.width) / view.imageHeight;
        const double scaleZ = static_cast<double>(pass.map.height) / view.imageHeight;
        plan.storageFactor += pass.promised.x * pass.promised.z * scaleX * scaleZ;
    }
    plan.promised = {setup.worst().x, setup.worst().z};
}

} // namespace gnomon::plan
