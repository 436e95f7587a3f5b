#include "plan/shadow_passes.h"

#include "plan/scheme_choice.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

namespace {

/// Returns true if a caster in the shadow map of `pass` can be nearer to the light than the depth range of this map.
bool reachesBefore(const ShadowPass& pass, const CameraBasis& basis, const SceneFacts& scene) {
    if (!scene.light) return true;
    const glm::dmat4 rows = glm::transpose(pass.map.lightClipFromCamera());
    // The row of the projection matrix for depth times w. For all possible casters, w is above 0.
    const glm::dvec3 normal(rows[2]);
    const double length = glm::length(normal);
    ConvexVolume before = pass.map.casterVolume;
    before.planes.push_back({-normal / length, -rows[2].w / length});
    return trianglesIn(before, basis, scene.light->casters) > 0;
}

SkipReason warpReason(const FramePlan& plan) {
    const Quality& quality = plan.quality;
    if (plan.view.camera.isParallel()) return SkipReason::ParallelSight;
    if (quality.stabilize) return SkipReason::SlicesStabilized;
    if (quality.warp.rule == shadow::WarpRule::None) return SkipReason::SwitchedOff;
    return SkipReason::NoGain;
}

/// Returns the reason why shadow maps have evenly spaced rows although the setting of the warp is `auto`.
SkipReason rowsReason(const FramePlan& plan) {
    if (!plan.backend.unevenRows) return SkipReason::BackendHasEvenRows;
    return plan.quality.zPartitions ? SkipReason::SlicesGiven : SkipReason::BetterWithout;
}

/// Adds the reason for each effect that the plan skips to plan.omitted, unless it already contains the effect.
void explainSkipped(FramePlan& plan, std::uint64_t emptySlices) {
    std::vector<SkippedEffect>& omitted = plan.omitted;
    const Quality& quality = plan.quality;
    for (std::size_t i = 0; i + 1 < plan.splits.size(); ++i)
        if ((emptySlices >> i & 1U) != 0) omitted.push_back({Effect::MapOfSlice, SkipReason::NothingFacesLight, i});
    if (plan.view.camera.isParallel())
        omitted.push_back({Effect::FacePartitions, SkipReason::ParallelSight});
    else if (quality.facePartitions != Choice::Off && quality.stabilize)
        omitted.push_back({Effect::FacePartitions, SkipReason::SlicesStabilized});
    else if (quality.facePartitions == Choice::Off)
        omitted.push_back({Effect::FacePartitions, SkipReason::SwitchedOff});
    else if (quality.facePartitions == Choice::On && !plan.hasFaces)
        omitted.push_back({Effect::FacePartitions, SkipReason::LightGrazesFaces});
    if (plan.splits.size() == 2)
        omitted.push_back(
            {Effect::ZPartitions, quality.zPartitions ? SkipReason::SwitchedOff : SkipReason::OneSliceSuffices});
    const auto isWarped = [](const ShadowPass& pass) { return pass.map.warped.kappa > 0; };
    const auto isLog = [](const ShadowPass& pass) { return shadow::hasLogRows(pass.map.warped); };
    if (std::none_of(plan.passes.begin(), plan.passes.end(), isWarped))
        omitted.push_back({Effect::Warp, warpReason(plan)});
    else if (quality.warp.rule == shadow::WarpRule::Auto && std::none_of(plan.passes.begin(), plan.passes.end(), isLog))
        omitted.push_back({Effect::LogRows, rowsReason(plan)});
    if (!quality.stabilize) {
        omitted.push_back({Effect::Stabilization, SkipReason::SwitchedOff});
        omitted.push_back({Effect::MapReuse, SkipReason::NotStabilized});
    }
    if (quality.filter == 0) omitted.push_back({Effect::Filter, SkipReason::SwitchedOff});
    const auto clamps = [](const ShadowPass& pass) { return pass.clampsDepth; };
    if (std::none_of(plan.passes.begin(), plan.passes.end(), clamps))
        omitted.push_back({Effect::DepthClamp, SkipReason::NoCasterBeforeMaps});
    if (quality.cullCasters == CasterCulling::Off)
        omitted.push_back({Effect::PartitionCulling, SkipReason::SwitchedOff});
}

} // namespace

SchemeMemory planShadowPasses(FramePlan& plan, const SceneFacts& scene, const std::optional<SchemeMemory>& before) {
    SchemeContext context;
    context.view.frustum = {plan.near, plan.far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
    context.view.shown = plan.shown;
    context.view.towardsLight = plan.towardsLight;
    context.view.imageHeight = plan.view.height;
    context.view.anchor = {plan.basis, plan.view.camera.eye};
    if (scene.light) context.view.seen = scene.light->seen;
    context.basis = plan.basis;
    context.quality = plan.quality;
    context.backend = plan.backend;
    context.scene = &scene;
    context.before = before;
    context.receivers = receiversOf(context);
    const SchemeCandidate chosen = chosenScheme(context, plan.omitted);
    const shadow::ShadowMapSetup& setup = chosen.setup;
    plan.cost = chosen.cost;
    plan.requiredTexels = chosen.requiredTexels;
    plan.isBoundKept = chosen.isWithinMaxAliasing || plan.quality.zPartitions;
    plan.selector = setup.selector;
    plan.splits = setup.selector.splits;
    plan.hasFaces = !setup.selector.faces.empty();
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
        plan.storageFactor += pass.map.aliasingBound.x * pass.map.aliasingBound.z * (texels.s / plan.view.height) *
                              (texels.t / plan.view.height);
    }
    plan.aliasingBound = {setup.worst().x, setup.worst().z};
    explainSkipped(plan, chosen.options.emptySlices);
    return {
        chosen.choice,
        setup.orientation,
        chosen.options.emptySlices,
        plan.passes.size(),
        context.receivers.memory,
        chosen.framesDominated};
}

} // namespace gnomon::plan
