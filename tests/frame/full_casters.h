// Pictures with the casters of the plan beside pictures with every caster off screen at full detail.
#pragma once

#include "hierarchy/model_file.h"
#include "plan/frame_plan.h"

namespace gnomon::tests {

/// What coarser casters off screen change in a picture.
struct CasterDifference {
    double wrongFraction = 0;                 // of the pixels: those any channel of which differs by more than 2 levels
    std::uint64_t offScreenTriangles = 0;     // in the maps, of clusters wholly out of view, as the plan has them
    std::uint64_t fullOffScreenTriangles = 0; // and at full detail
};

/// Draws `view` twice with the software backend. What is in view casts with the clusters that are drawn in both.
CasterDifference casterDifference(
    const hierarchy::ModelFile& model, const plan::View& view, const plan::Quality& quality);

} // namespace gnomon::tests
