#include "plan/caster_culling.h"

namespace gnomon::plan {

namespace {

std::optional<SkipReason> whyNoReceivers(const FramePlan& plan) {
    const Quality& quality = plan.quality;
    if (quality.cullCasters == CasterCulling::Off || quality.cullCasters == CasterCulling::On)
        return SkipReason::SwitchedOff;
    if (!plan.backend.imageFirst) return SkipReason::MapsComeFirst;
    if (quality.cullCasters == CasterCulling::Receivers) return std::nullopt;
    if (quality.stabilize) return SkipReason::MapsAreKept;
    std::uint64_t triangles = 0;
    for (const ShadowPass& pass : plan.passes)
        triangles += pass.estimatedTriangles;
    const auto pixels = static_cast<std::uint64_t>(plan.view.width) * static_cast<std::uint64_t>(plan.view.height);
    if (triangles * kPixelsPerTriangle < pixels) return SkipReason::FewCasters;
    return std::nullopt;
}

} // namespace

void chooseCasterCulling(FramePlan& plan) {
    plan.casterCulling = plan.quality.cullCasters == CasterCulling::Off ? CasterCulling::Off : CasterCulling::On;
    if (plan.passes.empty()) return;
    if (const auto reason = whyNoReceivers(plan))
        plan.omitted.push_back({Effect::ReceiverMasks, *reason});
    else
        plan.casterCulling = CasterCulling::Receivers;
}

} // namespace gnomon::plan
