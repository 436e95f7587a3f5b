#include "plan/shadow_decision.h"

namespace gnomon::plan {

ShadowDecision chooseShadows(const Quality& quality, const Capabilities& backend) {
    if (quality.shadows != ShadowMode::Auto) return {quality.shadows, ShadowReason::Requested};
    if (hasNoSun(quality.look.shading)) return {ShadowMode::Off, ShadowReason::NoSun};
    if (quality.mapsBecause) return {ShadowMode::Maps, *quality.mapsBecause};
    if (!backend.exactShadows) return {ShadowMode::Maps, ShadowReason::BackendHasMaps};
    return {ShadowMode::Exact, ShadowReason::BackendIsExact};
}

} // namespace gnomon::plan
