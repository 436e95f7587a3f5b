// A test whether a visible surface faces the light. If none does, the frame needs no shadows.
#pragma once

#include "lod/cut.h"

namespace gnomon::lod {

/// Returns false if no triangle of `image` inside the view pyramid has its visible side towards `towardsLight` (unit,
/// local space). True is not certain: the function stops at the first triangle that may face the light.
bool mayFaceLight(const lod::CutQuery& query, const lod::DrawList& image, const glm::dvec3& towardsLight);

} // namespace gnomon::lod
