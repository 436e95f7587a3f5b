#include "plan/shadow_passes.h"

#include "plan/scheme_choice.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

namespace {

/// Returns true if a caster of the map of `pass` can be nearer to the light than the map's depth range.
bool reachesBefore(const ShadowPass& pass, const CameraBasis& basis, const SceneFacts& scene) {
    if (!scene.light) return true;
    const glm::dmat4 rows = glm::transpose(pass.map.lightClipFromCamera());
    const glm::dvec3 normal(rows[2]); // depth times w; w is above 0 for all possible casters
    const double length = glm::length(normal);
    ConvexVolume before = pass.map.casterVolume;
    before.planes.push_back({-normal / length, -rows[2].w / length});
    return trianglesIn(before, basis, scene.light->casters) > 0;
}

OmissionReason warpReason(const FramePlan& plan) {
    const Quality& quality = plan.quality;
    if (plan.view.camera.isParallel()) return OmissionReason::ParallelSight;
    if (quality.stabilize) return OmissionReason::SlicesStabilized;
    if (quality.warp.rule == shadow::WarpRule::None) return OmissionReason::SwitchedOff;
    return OmissionReason::NoGain;
}

/// Returns the reason why the rows are even although the warp is open.
OmissionReason rowsReason(const FramePlan& plan) {
    if (!plan.backend.unevenRows) return OmissionReason::BackendHasEvenRows;
    return plan.quality.zPartitions ? OmissionReason::SlicesGiven : OmissionReason::BetterWithout;
}

/// Adds an entry for each skipped effect that has no entry yet.
void explainOmissions(FramePlan& plan, std::uint64_t emptySlices) {
    std::vector<Omission>& omitted = plan.omitted;
    const Quality& quality = plan.quality;
    for (std::size_t i = 0; i + 1 < plan.splits.size(); ++i)
        if ((emptySlices >> i & 1U) != 0) omitted.push_back({Effect::MapOfSlice, OmissionReason::NothingFacesLight, i});
    if (plan.view.camera.isParallel())
        omitted.push_back({Effect::FacePartitions, OmissionReason::ParallelSight});
    else if (quality.facePartitions != Choice::Off && quality.stabilize)
        omitted.push_back({Effect::FacePartitions, OmissionReason::SlicesStabilized});
    else if (quality.facePartitions == Choice::Off)
        omitted.push_back({Effect::FacePartitions, OmissionReason::SwitchedOff});
    else if (quality.facePartitions == Choice::On && !plan.hasFaces)
        omitted.push_back({Effect::FacePartitions, OmissionReason::LightGrazesFaces});
    if (plan.splits.size() == 2)
        omitted.push_back(
            {Effect::ZPartitions,
             quality.zPartitions ? OmissionReason::SwitchedOff : OmissionReason::OneSliceSuffices});
    const auto isWarped = [](const ShadowPass& pass) { return pass.map.warped.kappa > 0; };
    const auto isLog = [](const ShadowPass& pass) { return shadow::hasLogRows(pass.map.warped); };
    if (std::none_of(plan.passes.begin(), plan.passes.end(), isWarped))
        omitted.push_back({Effect::Warp, warpReason(plan)});
    else if (quality.warp.rule == shadow::WarpRule::Auto && std::none_of(plan.passes.begin(), plan.passes.end(), isLog))
        omitted.push_back({Effect::LogRows, rowsReason(plan)});
    if (!quality.stabilize) {
        omitted.push_back({Effect::Stabilization, OmissionReason::SwitchedOff});
        omitted.push_back({Effect::MapReuse, OmissionReason::NotStabilized});
    }
    if (quality.filter == 0) omitted.push_back({Effect::Filter, OmissionReason::SwitchedOff});
    const auto clamps = [](const ShadowPass& pass) { return pass.clampsDepth; };
    if (std::none_of(plan.passes.begin(), plan.passes.end(), clamps))
        omitted.push_back({Effect::DepthClamp, OmissionReason::NoCasterBeforeMaps});
    if (quality.cullCasters == CasterCulling::Off)
        omitted.push_back({Effect::PartitionCulling, OmissionReason::SwitchedOff});
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
    plan.texelsThatWouldDo = chosen.texelsThatWouldDo;
    plan.promiseKept = chosen.keepsPromise || plan.quality.zPartitions;
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
        plan.storageFactor +=
            pass.map.promised.x * pass.map.promised.z * (texels.s / plan.view.height) * (texels.t / plan.view.height);
    }
    plan.promised = {setup.worst().x, setup.worst().z};
    explainOmissions(plan, chosen.options.emptySlices);
    return {
        chosen.choice,
        setup.orientation,
        chosen.options.emptySlices,
        plan.passes.size(),
        context.receivers.memory,
        chosen.framesDominated};
}

} // namespace gnomon::plan
