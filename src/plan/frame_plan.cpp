#include "plan/frame_plan.h"

#include <algorithm>

namespace gnomon::plan {

std::string schemeName(const FramePlan& plan) {
    if (plan.quality.shadows == ShadowMode::Off) return "off";
    if (plan.quality.shadows == ShadowMode::Rays) return "rays";
    if (plan.quality.shadows == ShadowMode::Exact) return "exact";
    if (plan.passes.empty()) return "none";
    if (plan.view.pointLight) return "cube";
    const std::size_t slices = plan.splits.size() - 1;
    std::string name;
    if (plan.hasFaces) name = slices > 1 ? "fp+" : "fp";
    if (slices > 1) name += "zp" + std::to_string(slices);
    if (name.empty()) name = "map";
    const auto isAny = [&](auto is) {
        return std::any_of(
            plan.passes.begin(), plan.passes.end(), [&](const ShadowPass& pass) { return is(pass.map.warped); });
    };
    if (isAny(shadow::hasLogRows)) return name + "+log";
    return isAny([](const shadow::WarpedMap& map) { return map.kappa > 0; }) ? name + "+w" : name;
}

} // namespace gnomon::plan
