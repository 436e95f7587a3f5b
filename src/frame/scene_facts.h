// The scene facts that a plan needs, and the conversion of views and volumes to the local space of the hierarchy.
#pragma once

#include "lod/cut.h"
#include "lod/receivers.h"
#include "plan/frame_plan.h"

namespace gnomon::frame {

/// Returns `view` with the parameters that the selection of detail needs. `eye` is the eye in local space.
lod::DetailView detailView(const plan::View& view, const glm::dvec3& eye);

/// Returns the scene facts that the plan of `view` needs, computed from the first cut of the frame. If `range` (the
/// result of plan::widestRange) is given, the facts include receivers and casters; `cut` must then have one caster
/// list, for all casters that can throw a shadow into `range`. `scratch` is temporary memory.
plan::SceneFacts sceneFacts(
    const plan::View& view,
    const Box& bounds,
    const lod::CutQuery& query,
    const lod::Cut& cut,
    const std::optional<DepthSpan>& range,
    std::vector<lod::DepthCandidate>& scratch);

/// Returns true if certainly no visible cluster in the image of `cut` faces the light. If the result is false, some
/// cluster may face it.
bool isTurnedFromLight(const plan::View& view, const lod::CutQuery& query, const lod::Cut& cut);

} // namespace gnomon::frame
