// The facts of a scene that a plan needs, and the conversion of views and volumes to the local space of the hierarchy.
#pragma once

#include "lod/cut.h"
#include "lod/receivers.h"
#include "plan/frame_plan.h"

namespace gnomon::frame {

/// Returns the parameters of `view` for the selection of detail. `eye` is in local space.
lod::DetailView detailView(const plan::View& view, const glm::dvec3& eye);

/// Returns the facts for a plan of `view`. If `range` (the result of widestRange) is given, `cut` has one list of
/// the casters around the image.
plan::SceneFacts sceneFacts(
    const plan::View& view,
    const Box& bounds,
    const lod::CutQuery& query,
    const lod::Cut& cut,
    const std::optional<DepthSpan>& range,
    std::vector<lod::DepthCandidate>& scratch);

/// Returns true if no visible cluster of the image of `cut` can be lit, even without casters. False is not certain.
bool isTurnedFromLight(const plan::View& view, const lod::CutQuery& query, const lod::Cut& cut);

} // namespace gnomon::frame
