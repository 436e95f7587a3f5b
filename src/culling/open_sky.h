// Whether anything stands between what is seen and the sky.
#pragma once

#include "selection/cut.h"

namespace gnomon::culling {

/// Whether anything of the model, whose bounds in local space are `bounds`, may lie before the plane of a triangle of
/// `image`, on the side of the eye, by more than two steps of the grid: only sure where it says no. A triangle may be
/// hidden, and counts: so a closed solid is never found to be open. Of what is not drawn in `image` only the bounds are
/// known.
bool mayHideSky(const selection::CutQuery& query, const selection::DrawList& image, const Box& bounds);

} // namespace gnomon::culling
