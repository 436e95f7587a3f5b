// A test whether geometry can lie between the visible surfaces and the sky.
#pragma once

#include "lod/cut.h"

#include <cstdint>

namespace gnomon::lod {

/// Tells whether the back faces of a closed solid are always hidden. Section planes may cut solids open, and this is
/// then not certain.
enum class Solids : std::uint8_t { Whole, MayBeCut };

/// Returns false if no geometry of the model can lie in front of the plane of a triangle of `image`, on the side of the
/// eye, by more than two grid steps. True is not certain. `bounds` are the model's bounds in local space.
///
/// Hidden triangles also count, with one exception: back faces of a closed convex solid that is seen from outside as a
/// whole. In such a solid, each edge belongs to two triangles, and no geometry lies outside the plane of a triangle.
/// For geometry that is not drawn in `image`, the function knows only `bounds`.
bool mayHideSky(const lod::CutQuery& query, const lod::DrawList& image, const Box& bounds, Solids solids);

} // namespace gnomon::lod
