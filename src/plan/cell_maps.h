// How the cells of exact shadows lie over the light plane: with the matrices of shadow maps, which put as many cells
// where the view has as many pixels. They change what a frame costs, never its picture.
#pragma once

#include "plan/frame_plan.h"

#include <vector>

namespace gnomon::plan {

/// Cells on each side of all maps of a frame together, as if they were one.
inline constexpr int kCellSide = 256;

/// Cells on each side of one of the plan's maps.
int cellSide(const FramePlan& plan);

/// The maps of `plan`, whose view, light and depth range are set, as its quality has it; nearest slice first. By
/// default one, warped as LSPSM (Wimmer et al. 2004): more partitions have triangles cast more than once, for lists
/// that are short enough with one.
std::vector<shadow::ShadowMap> cellMaps(const FramePlan& plan);

} // namespace gnomon::plan
