// Plans the shadow maps of a point light (lamp).
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Returns the position of the point light of `view` in camera space. Requires that `view` has a point light.
glm::dvec3 lampInCamera(const View& view);

/// Adds one shadow map to `plan` per face of a cube around the point light, for each face with visible surfaces. The
/// depth range and camera axes of `plan` must be set, and its view must have a point light.
void planLampPasses(FramePlan& plan, const SceneFacts& scene);

} // namespace gnomon::plan
