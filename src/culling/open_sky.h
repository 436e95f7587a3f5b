// Whether anything stands between what is seen and the sky.
#pragma once

#include "selection/cut.h"

#include <cstdint>

namespace gnomon::culling {

/// Whether a closed solid may be told by its far sides, which are hidden then. Not where it is cut open.
enum class Solids : std::uint8_t { Whole, MayBeCut };

/// Whether anything of the model, whose bounds in local space are `bounds`, may lie before the plane of a triangle of
/// `image`, on the side of the eye, by more than two steps of the grid: only sure where it says no. A triangle may be
/// hidden, and counts, but for the far sides of a closed convex solid that is seen from outside as a whole: of a
/// surface whose edges all belong to two triangles, and of which nothing lies outside any of them. Of what is not drawn
/// in `image` only the bounds are known.
bool mayHideSky(const selection::CutQuery& query, const selection::DrawList& image, const Box& bounds, Solids solids);

} // namespace gnomon::culling
