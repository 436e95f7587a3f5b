// The choice between shadow maps, exact shadows, rays and no shadows for a frame. Only this file makes the choice.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// The chosen kind of shadows of a frame, and the reason for it.
struct ShadowDecision {
    ShadowMode mode = ShadowMode::Maps; // never Auto
    ShadowReason reason = ShadowReason::Requested;
};

/// Returns the kind of shadows that `backend` draws for `quality`. Auto becomes Off if the shading has no sun.
/// Otherwise it becomes Maps if `quality` requests maps or if the backend draws only maps. In all other cases it
/// becomes Exact.
ShadowDecision chooseShadows(const Quality& quality, const Capabilities& backend);

} // namespace gnomon::plan
