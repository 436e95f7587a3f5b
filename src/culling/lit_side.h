// Whether anything that is seen faces the light: where nothing does, a frame goes without shadows of any kind.
#pragma once

#include "selection/cut.h"

namespace gnomon::culling {

/// Whether any triangle of `image` that reaches into the view's pyramid may have its seen side towards `towardsLight`
/// (unit, local space). Only sure where it says no; stops at the first that may.
bool mayFaceLight(const selection::CutQuery& query, const selection::DrawList& image, const glm::dvec3& towardsLight);

} // namespace gnomon::culling
