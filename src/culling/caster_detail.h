// Conversion of a shadow map to the input of the error rule: volumes and texels in the model's local space.
#pragma once

#include "selection/error_rule.h"
#include "shadow/shadow_map.h"

namespace gnomon::culling {

/// Returns the required detail of the casters of `map`. `map` must be in the camera space of `view`.
selection::CasterDetail casterDetail(const selection::DetailView& view, const shadow::ShadowMap& map);

} // namespace gnomon::culling
