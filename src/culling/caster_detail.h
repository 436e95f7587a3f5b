// From a fitted shadow map to what the error rule must know of it: volumes and texels in the model's local space.
#pragma once

#include "selection/error_rule.h"
#include "shadow/shadow_map.h"

namespace gnomon::culling {

/// What the casters of `map` must be exact enough for; `view` must be the one whose camera space it is given in.
selection::CasterDetail casterDetail(const selection::DetailView& view, const shadow::ShadowMap& map);

} // namespace gnomon::culling
