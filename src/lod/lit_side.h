// Tests whether any visible surface faces the light. If no surface does, the frame needs no shadows.
#pragma once

#include "lod/cut.h"

namespace gnomon::lod {

/// Returns false if certainly no triangle of `image` in the view pyramid has its visible side towards `towardsLight`
/// (unit, local space). Returns true if some triangle may face the light; the function stops at the first such
/// triangle.
bool mayFaceLight(const lod::CutQuery& query, const lod::DrawList& image, const glm::dvec3& towardsLight);

} // namespace gnomon::lod
