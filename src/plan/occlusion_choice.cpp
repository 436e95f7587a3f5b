#include "plan/occlusion_choice.h"

namespace gnomon::plan {

namespace {

std::optional<SkipReason> reasonToDrawAll(const FramePlan& plan, double layers) {
    if (plan.quality.occlusion == Choice::Off) return SkipReason::SwitchedOff;
    if (!plan.backend.occlusionCulling) return SkipReason::BackendDrawsAll;
    if (plan.quality.occlusion == Choice::Auto && layers < kMinLayers) return SkipReason::FewLayers;
    return std::nullopt;
}

} // namespace

void chooseOcclusion(FramePlan& plan, double layers) {
    const std::optional<SkipReason> reason = reasonToDrawAll(plan, layers);
    plan.skipsHidden = !reason;
    if (reason) plan.omitted.push_back({Effect::OcclusionCulling, *reason});
}

} // namespace gnomon::plan
