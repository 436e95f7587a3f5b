// Converts a shadow map to the input of the error rule: volumes and texels in the model's local space.
#pragma once

#include "lod/error_rule.h"
#include "shadow/shadow_map.h"

namespace gnomon::lod {

/// Returns the detail that the casters of `map` require. `map` must be in the camera space of `view`.
lod::CasterDetail casterDetail(const lod::DetailView& view, const shadow::ShadowMap& map);

} // namespace gnomon::lod
