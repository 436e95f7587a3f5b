// The floors of a model: coarse for the whole model, or fine for a region.
#pragma once

#include "hierarchy/model_file.h"
#include "path/walkable_floor.h"

namespace gnomon::path {

/// A range of floor heights, in world units.
struct HeightBand {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    bool holds(double height) const { return height >= low && height <= high; }
};

/// Returns the bounds of `model` in upright space (hierarchy/upright_frame.h). Floors and walks use upright space.
Box uprightBounds(const hierarchy::ModelFile& model);

/// Returns the floor of the part of `model` in `region` (upright space), over square columns of side `cell`. The floor
/// comes from a cut whose error is a fifth of `cell`, or larger if the cut would have more than about 12 million
/// triangles. Each point within this error of the cut counts as solid. A body that is clear of the cut is therefore
/// clear of the model.
WalkableFloor floorOf(const hierarchy::ModelFile& model, const Box& region, const WalkBody& body, double cell);

/// Returns the side of columns for a fine floor.
inline double fineCell(const WalkBody& body) {
    return 0.1 * body.eyeHeight / 1.7;
}

/// Returns the squares of side `side` with the most floor within `band`, at most `count` and disjoint. Squares are
/// smaller at the model's border. Floor below a ceiling and beside objects counts more. The best squares come first;
/// equal squares are sorted by their distance to the middle.
std::vector<Box> bestRegions(const WalkableFloor& coarse, const HeightBand& band, double side, std::size_t count);

} // namespace gnomon::path
