#include "plan/lamp/lamp_passes.h"

#include "plan/scheme_choice.h"
#include "shadow/cube/cube_maps.h"

namespace gnomon::plan {

namespace {

shadow::ShadowOptions optionsOf(const Quality& quality) {
    shadow::ShadowOptions options;
    options.filterTexels = quality.filter;
    options.texels =
        static_cast<std::uint64_t>(quality.shadowTexelsWidth) * static_cast<std::uint64_t>(quality.shadowTexelsHeight);
    return options;
}

void explainSkipped(FramePlan& plan) {
    for (const Effect effect :
         {Effect::ZPartitions, Effect::FacePartitions, Effect::Warp, Effect::Stabilization, Effect::MapReuse})
        plan.omitted.push_back({effect, SkipReason::FacesOfCube});
    if (plan.quality.filter == 0) plan.omitted.push_back({Effect::Filter, SkipReason::SwitchedOff});
    if (plan.quality.cullCasters == CasterCulling::Off)
        plan.omitted.push_back({Effect::PartitionCulling, SkipReason::SwitchedOff});
}

} // namespace

glm::dvec3 lampInCamera(const View& view) {
    return toCamera(cameraBasis(view.camera), view.pointLight->at - view.camera.eye);
}

void planLampPasses(FramePlan& plan, const SceneFacts& scene) {
    shadow::LampView lamp;
    lamp.light = lampInCamera(plan.view);
    lamp.basis = plan.basis;
    lamp.frustum = {plan.near, plan.far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
    lamp.shown = plan.shown;
    lamp.imageHeight = plan.view.height;
    if (scene.light) lamp.seen = scene.light->seen;
    const shadow::ShadowOptions options = optionsOf(plan.quality);
    const shadow::ShadowMapSetup setup = shadow::cubeMapSetup(lamp, options);
    plan.selector = setup.selector;
    plan.splits = setup.selector.splits;
    plan.textureWidth = setup.textureWidth;
    plan.textureHeight = setup.textureHeight;
    for (const std::size_t map : setup.mapOfPartition)
        plan.passOfPartition.push_back(map == shadow::ShadowMapSetup::kNoMap ? -1 : static_cast<int>(map));
    for (const shadow::ShadowMap& map : setup.maps) {
        ShadowPass& pass = plan.passes.emplace_back();
        pass.map = map;
        const ConvexVolume volume = plan.quality.cullCasters == CasterCulling::Off ? ConvexVolume{} : map.casterVolume;
        if (scene.light) pass.estimatedTriangles = trianglesIn(volume, plan.basis, scene.light->casters);
        plan.cost += pass.estimatedTriangles;
    }
    plan.cost += static_cast<std::uint64_t>(plan.textureWidth) * static_cast<std::uint64_t>(plan.textureHeight) / 16;
    plan.aliasingBound = {setup.worst().x, setup.worst().z};
    plan.requiredTexels = shadow::requiredTexels(setup, options, plan.quality.maxAliasing);
    explainSkipped(plan);
}

} // namespace gnomon::plan
