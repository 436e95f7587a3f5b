#include "plan/occlusion_choice.h"

namespace gnomon::plan {

namespace {

std::optional<OmissionReason> reasonToDrawAll(const FramePlan& plan, double layers) {
    if (plan.quality.occlusion == Choice::Off) return OmissionReason::SwitchedOff;
    if (!plan.backend.occlusionCulling) return OmissionReason::BackendDrawsAll;
    if (plan.quality.occlusion == Choice::Auto && layers < kLeastLayers) return OmissionReason::FewLayers;
    return std::nullopt;
}

} // namespace

void chooseOcclusion(FramePlan& plan, double layers) {
    const std::optional<OmissionReason> reason = reasonToDrawAll(plan, layers);
    plan.skipsHidden = !reason;
    if (reason) plan.omitted.push_back({Effect::OcclusionCulling, *reason});
}

} // namespace gnomon::plan
