// The choice between shadow maps, exact shadows, rays and no shadows for a frame. No other file makes this choice.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// The chosen kind of shadows of a frame, and the reason for it.
struct ShadowDecision {
    ShadowMode mode = ShadowMode::Maps; // never Auto
    ShadowReason reason = ShadowReason::Requested;
};

/// Returns the kind of shadows that `backend` draws for `quality`. Auto is Off if the shading has no sun. Otherwise it
/// is Maps if `quality` requests them or the backend draws nothing else, and Exact in all other cases.
ShadowDecision chooseShadows(const Quality& quality, const Capabilities& backend);

} // namespace gnomon::plan
