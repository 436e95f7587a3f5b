#include "plan/shadow_passes.h"

#include "plan/scheme_choice.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

namespace {

/// Whether something that can throw a shadow into the map of `pass` is nearer to the light than its depth begins.
bool reachesBefore(const ShadowPass& pass, const CameraBasis& basis, const SceneFacts& scene) {
    if (!scene.light) return true;
    const glm::dmat4 rows = glm::transpose(pass.map.lightClipFromCamera());
    const glm::dvec3 normal(rows[2]); // depth w; w is above 0 in front of whatever can cast
    const double length = glm::length(normal);
    ConvexVolume before = pass.map.casterVolume;
    before.planes.push_back({-normal / length, -rows[2].w / length});
    return trianglesIn(before, basis, scene.light->casters) > 0;
}

std::string warpReason(const FramePlan& plan) {
    if (plan.quality.stabilize) return "stabilised slices are unwarped";
    if (plan.quality.warp.rule == shadow::WarpRule::None) return "switched off";
    return "it would not lower the promise under this light";
}

/// A line for each effect that the maps go without and that no choice has spoken of.
void explainOmissions(FramePlan& plan) {
    std::vector<Omission>& omitted = plan.omitted;
    for (std::size_t i = 0; i + 1 < plan.splits.size(); ++i)
        if ((plan.emptySlices >> i & 1U) != 0)
            omitted.push_back({"map of slice " + std::to_string(i), "nothing that is seen in it faces the light"});
    const bool isFaceLeft = plan.quality.facePartitions == Choice::On && !plan.hasFaces;
    if (plan.quality.facePartitions != Choice::Off && plan.quality.stabilize) {
        omitted.push_back({"face partitions", "stabilised slices are whole"});
    } else if (plan.quality.facePartitions == Choice::Off) {
        omitted.push_back({"face partitions", "switched off"});
    } else if (isFaceLeft) {
        omitted.push_back({"face partitions", "the light grazes every face of the view"});
    }
    if (plan.splits.size() == 2)
        omitted.push_back(
            {"z-partitions", plan.quality.zPartitions ? "switched off" : "a single slice is best at this promise"});
    const auto isWarped = [](const ShadowPass& pass) { return pass.map.warped.kappa > 0; };
    if (std::none_of(plan.passes.begin(), plan.passes.end(), isWarped)) omitted.push_back({"warp", warpReason(plan)});
    if (!plan.quality.stabilize) {
        omitted.push_back({"stabilisation", "switched off"});
        omitted.push_back({"reuse of maps", "only stabilised ones stay where they are while the camera moves"});
    }
    if (plan.quality.filter == 0)
        omitted.push_back({"filter", "switched off; its kernel would widen the texels, and so raise the promise"});
    const auto clamps = [](const ShadowPass& pass) { return pass.clampsDepth; };
    if (std::none_of(plan.passes.begin(), plan.passes.end(), clamps))
        omitted.push_back({"depth clamp", "no caster is nearer to the light than its map begins"});
    if (!plan.quality.cullCasters) omitted.push_back({"partition culling", "switched off"});
}

} // namespace

void planShadowPasses(FramePlan& plan, const SceneFacts& scene, const FramePlan* previous) {
    SchemeContext context;
    context.view.frustum = {plan.near, plan.far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
    context.view.towardsLight = plan.towardsLight;
    context.view.imageHeight = plan.view.height;
    context.view.anchor = {plan.basis, plan.view.camera.eye};
    if (scene.light) context.view.seen = scene.light->seen;
    context.basis = plan.basis;
    context.quality = plan.quality;
    context.scene = &scene;
    if (previous != nullptr && previous->scheme) context.previous = previous;
    context.receivers = receiversOf(context);
    const SchemeCandidate chosen = chosenScheme(context, plan.omitted);
    const shadow::ShadowMapSetup& setup = chosen.setup;
    plan.scheme = chosen.choice;
    plan.framesDominated = chosen.framesDominated;
    plan.cost = chosen.cost;
    plan.texelsThatWouldDo = chosen.texelsThatWouldDo;
    plan.promiseKept = chosen.keepsPromise || plan.quality.zPartitions;
    plan.selector = setup.selector;
    plan.splits = setup.selector.splits;
    plan.emptySlices = chosen.options.emptySlices;
    plan.litMemory = context.receivers.memory;
    plan.hasFaces = !setup.selector.faces.empty();
    plan.orientation = setup.orientation;
    plan.textureWidth = setup.textureWidth;
    plan.textureHeight = setup.textureHeight;
    for (const std::size_t map : setup.mapOfPartition)
        plan.passOfPartition.push_back(map == shadow::ShadowMapSetup::kNoMap ? -1 : static_cast<int>(map));
    plan.storageFactor = 0;
    for (std::size_t i = 0; i < setup.maps.size(); ++i) {
        ShadowPass& pass = plan.passes.emplace_back();
        pass.map = setup.maps[i];
        pass.estimatedTriangles = chosen.casterTriangles[i];
        pass.clampsDepth = reachesBefore(pass, plan.basis, scene);
        const shadow::Resolution texels = pass.map.texels();
        plan.storageFactor +=
            pass.map.promised.x * pass.map.promised.z * (texels.s / plan.view.height) * (texels.t / plan.view.height);
    }
    plan.promised = {setup.worst().x, setup.worst().z};
    explainOmissions(plan);
}

} // namespace gnomon::plan
