// Defines the grids of cells into which exact shadows sort the visible points. Each grid is projected like a shadow
// map, so regions with more pixels have more cells. The grids change the drawing time of a frame, but not its image.
#pragma once

#include "plan/frame_plan.h"

#include <vector>

namespace gnomon::plan {

/// Number of cells per side of the grid if a frame has one grid. With n grids, each has 256 / sqrt(n) cells per side,
/// so the total number of cells stays the same.
inline constexpr int kCellSide = 256;

/// Returns the number of cells per side of each grid that exact shadows use for `plan`.
int cellSide(const FramePlan& plan);

/// Returns the shadow maps whose projections define the grids, nearest slice first. `plan` must have its view, light
/// and depth range. Its `quality.cellScheme` selects the layout. The default is one map with the warp of LSPSM (Wimmer
/// et al. 2004). More maps would rasterise some triangles several times, and would save little, because one map already
/// has few visible points per cell.
std::vector<shadow::ShadowMap> sampleGridMaps(const FramePlan& plan);

} // namespace gnomon::plan
