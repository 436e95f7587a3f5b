// Tests whether geometry can be between the visible surfaces and the sky.
#pragma once

#include "lod/cut.h"

#include <cstdint>

namespace gnomon::lod {

/// Tells whether section planes may have cut closed solids open. Only the back faces of an uncut closed solid are
/// certainly hidden from outside.
enum class Solids : std::uint8_t { Whole, MayBeCut };

/// Returns false if certainly no geometry of the model hides a part of the sky from a visible surface. The function
/// tests for each triangle of `image` whether geometry is in front of the triangle's plane, on the side of the eye, by
/// more than two grid steps. If the result is true, geometry may hide a part of the sky. `bounds` are the model's
/// bounds in local space.
///
/// Hidden triangles are also tested, with one exception: back faces of a closed convex solid that is seen from outside
/// as a whole. In such a solid, each edge belongs to two triangles, and no geometry is in front of the plane of a
/// triangle. For geometry that is not drawn in `image`, the function uses only `bounds`.
bool mayHideSky(const lod::CutQuery& query, const lod::DrawList& image, const Box& bounds, Solids solids);

} // namespace gnomon::lod
