// Chooses between shadow maps, exact shadows, rays and no shadows for a frame.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// The chosen type of shadows of a frame, and the reason for this choice.
struct ShadowDecision {
    ShadowMode mode = ShadowMode::Maps; // never Auto
    ShadowReason reason = ShadowReason::Requested;
};

/// Returns the type of shadows that `backend` draws for `quality`. Auto becomes Off if the shading has no sun.
/// Otherwise Auto becomes Maps if `quality` requests maps or if the backend draws only maps. In all other cases Auto
/// becomes Exact.
ShadowDecision chooseShadows(const Quality& quality, const Capabilities& backend);

} // namespace gnomon::plan
