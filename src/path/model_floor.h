// Finds the floors of a model: coarsely for the whole model, or finely for a region.
#pragma once

#include "hierarchy/model_file.h"
#include "path/walkable_floor.h"

namespace gnomon::path {

/// A range of floor heights in world units.
struct HeightBand {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    bool holds(double height) const { return height >= low && height <= high; }
};

/// Returns the bounds of `model` in upright space, in which y is up (hierarchy/upright_frame.h). Floors and walks use
/// this space.
Box uprightBounds(const hierarchy::ModelFile& model);

/// Returns the floor of `model` inside `region` (upright space), over square columns of side `cell`. The geometry is a
/// cut whose error is a fifth of `cell`, or larger if the cut would have more than about 12 million triangles. Each
/// point within this error of the cut counts as solid. A body that does not touch these solids therefore does not touch
/// the model.
WalkableFloor floorOf(const hierarchy::ModelFile& model, const Box& region, const WalkBody& body, double cell);

/// Returns the side of the square columns in which a fine floor for `body` is computed, in world units.
inline double fineCell(const WalkBody& body) {
    return 0.1 * body.eyeHeight / 1.7;
}

/// Returns at most `count` disjoint squares with the most floor within the heights `band`. Their side is `side`, or
/// less at the border of the model. Floor below a ceiling and beside objects counts more. The best squares come first.
/// Equal squares are sorted by their distance to the middle.
std::vector<Box> bestRegions(const WalkableFloor& coarse, const HeightBand& band, double side, std::size_t count);

} // namespace gnomon::path
