// Between a plan and the hierarchy: the views, volumes and details in its local space that a plan calls for, and
// the facts for the plan that they select.
#pragma once

#include "culling/receivers.h"
#include "plan/frame_plan.h"
#include "selection/cut.h"

namespace gnomon::frame {

/// `view` for choosing detail; `eye` is local.
selection::DetailView detailView(const plan::View& view, const glm::dvec3& eye);

/// What the geometry of `image` (the first list of `cut`) and of the casters around it (the second, if there is one)
/// tells a plan of `view`; `range` is what widestRange answered.
plan::SceneFacts sceneFacts(
    const plan::View& view,
    const Box& bounds,
    const selection::CutQuery& query,
    const selection::Cut& cut,
    const std::optional<DepthSpan>& range,
    std::vector<culling::DepthCandidate>& scratch);

/// Whether nothing of `cut`'s image that is in view can be lit, whatever stands before the light; only sure where it
/// says yes.
bool isTurnedFromLight(const plan::View& view, const selection::CutQuery& query, const selection::Cut& cut);

} // namespace gnomon::frame
