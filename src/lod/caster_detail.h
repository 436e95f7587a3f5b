// Converts a shadow map to the input of the error rule, which selects the level of detail: volumes and texel sizes in
// the model's local space.
#pragma once

#include "lod/error_rule.h"
#include "shadow/shadow_map.h"

namespace gnomon::lod {

/// Returns the volumes and texel sizes that determine the level of detail of the casters of `map`. `map` must be in the
/// camera space of `view`.
lod::CasterDetail casterDetail(const lod::DetailView& view, const shadow::ShadowMap& map);

} // namespace gnomon::lod
