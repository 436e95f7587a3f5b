// How the cells of exact shadows lie over the light plane: with the matrices of shadow maps, which put as many cells
// where the view has as many pixels. They change what a frame costs, never its picture.
#pragma once

#include "plan/frame_plan.h"

#include <vector>

namespace gnomon::plan {

/// Cells on each side of a map.
inline constexpr int kCellSide = 256;

/// The maps of `plan`, whose view, light and depth range are set: one, warped as LSPSM (Wimmer et al. 2004). More
/// partitions would have triangles cast more than once, for lists that are short enough with one.
std::vector<shadow::ShadowMap> cellMaps(const FramePlan& plan);

} // namespace gnomon::plan
