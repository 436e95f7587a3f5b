// Collects the properties of the visible scene that a plan needs, and converts views to the local space of the model.
#pragma once

#include "lod/cut.h"
#include "lod/receivers.h"
#include "plan/frame_plan.h"

namespace gnomon::frame {

/// Returns the camera parameters of `view` that the selection of the level of detail needs. `eye` is the eye in local
/// space.
lod::DetailView detailView(const plan::View& view, const glm::dvec3& eye);

/// Returns the properties of the scene that the plan of `view` needs, computed from the clusters in `cut`. If `range`
/// (the result of plan::widestRange) is given, they include receivers and casters. `cut` must then have one caster
/// list, with all casters that can throw a shadow onto a visible point whose depth is in `range`. `scratch` is
/// temporary memory.
plan::SceneFacts sceneFacts(
    const plan::View& view,
    const Box& bounds,
    const lod::CutQuery& query,
    const lod::Cut& cut,
    const std::optional<DepthSpan>& range,
    std::vector<lod::DepthCandidate>& scratch);

/// Returns true if certainly no visible cluster in the image of `cut` faces the light. If the result is false, some
/// cluster may face the light.
bool isTurnedFromLight(const plan::View& view, const lod::CutQuery& query, const lod::Cut& cut);

} // namespace gnomon::frame
