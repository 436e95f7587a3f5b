// How wide penumbrae can be in a view: what tells a plan whether the light's disc shows at all.
#pragma once

#include "selection/cut.h"

#include <span>

namespace gnomon::culling {

/// A light that is seen as a disc.
struct DiscLight {
    glm::dvec3 towards{0, 1, 0}; // its middle: unit, local space
    double slope = 0;            // width of a penumbra over the distance from what throws it: 2 tan(angle / 2)
};

/// An upper bound of how wide the penumbrae are, in pixels across the beam, that clusters of `casters` throw on those
/// of `image`: by the distance along the light between boxes of drawn clusters, one of which may stand in the beams
/// that reach the other, and by the least depth of the latter, which is at least `nearest`; all lists are draw lists of
/// `query`. 0 where no box stands before another.
double widestPenumbra(
    const selection::CutQuery& query,
    const selection::DrawList& image,
    std::span<const selection::DrawList> casters,
    const DiscLight& light,
    double nearest);

} // namespace gnomon::culling
