// The shadow maps of a lamp's frame.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Where the point light of `view`, which has one, stands in camera space.
glm::dvec3 lampInCamera(const View& view);

/// Gives `plan`, whose range and basis are set and whose view has a point light, a map for each face of a cube about
/// that through which anything is seen.
void planLampPasses(FramePlan& plan, const SceneFacts& scene);

} // namespace gnomon::plan
