// The grids of cells into which exact shadows sort the samples. Each grid has the matrix of a shadow map, so regions
// with more pixels have more cells. The grids change the drawing time of a frame, but not its image.
#pragma once

#include "plan/frame_plan.h"

#include <vector>

namespace gnomon::plan {

/// Number of cells per side of the grid of a frame with one map. With n maps, each grid has 256 / sqrt(n) cells per
/// side, so the total number of cells stays the same.
inline constexpr int kCellSide = 256;

/// Returns the number of cells per side of each of the plan's grids.
int cellSide(const FramePlan& plan);

/// Returns the shadow maps whose matrices define the grids, nearest slice first. `plan` must have its view, light and
/// depth range. Its `quality.cellScheme` selects the layout. The default is one map with the warp of LSPSM (Wimmer et
/// al. 2004). More partitions would rasterise some triangles several times, and would save little, because one map
/// already has few samples per cell.
std::vector<shadow::ShadowMap> sampleGridMaps(const FramePlan& plan);

} // namespace gnomon::plan
