// Comparison of pictures with planned casters against pictures with off-screen casters at full detail.
#pragma once

#include "hierarchy/model_file.h"
#include "plan/frame_plan.h"

namespace gnomon::tests {

/// The effect of coarser off-screen casters on a picture.
struct CasterDifference {
    double wrongFraction = 0;                 // share of the pixels with a channel that differs by more than 2 levels
    std::uint64_t offScreenTriangles = 0;     // triangles in the maps of clusters completely out of view, as planned
    std::uint64_t fullOffScreenTriangles = 0; // the same at full detail
};

/// Draws `view` twice with the software backend. What is in view casts with the clusters that are drawn in both.
CasterDifference casterDifference(
    const hierarchy::ModelFile& model, const plan::View& view, const plan::Quality& quality);

} // namespace gnomon::tests
