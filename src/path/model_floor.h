// The floors of a model: all of it coarsely, or a part of it as finely as a body needs.
#pragma once

#include "hierarchy/model_file.h"
#include "path/walkable_floor.h"

namespace gnomon::path {

/// Floors at heights from `low` to `high`, world units.
struct HeightBand {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    bool holds(double height) const { return height >= low && height <= high; }
};

/// The bounds of `model` in upright space (hierarchy/upright_frame.h), in which floors and walks are.
Box uprightBounds(const hierarchy::ModelFile& model);

/// The floor of what of `model` lies in `region`, upright space, over columns of side `cell`. It is that of a cut whose
/// error is a fifth of a cell, or as much more as it takes to read no more than about 12 million triangles, and all
/// that may be nearer than this error counts as solid: who keeps clear of the cut keeps clear of the model.
WalkableFloor floorOf(const hierarchy::ModelFile& model, const Box& region, const WalkBody& body, double cell);

/// The side of the columns over which a floor is found finely.
inline double fineCell(const WalkBody& body) {
    return 0.1 * body.eyeHeight / 1.7;
}

/// Squares of `side`, or less where the model ends, that hold the most floor within `band` (that under a ceiling and
/// beside things counts more), best first, then nearest to the middle; at most `count`, no two over each other.
std::vector<Box> bestRegions(const WalkableFloor& coarse, const HeightBand& band, double side, std::size_t count);

} // namespace gnomon::path
