// How wide penumbrae can be in a view: what tells a plan where the light's disc shows, if at all.
#pragma once

#include "selection/cut.h"
#include "shadow/image_tiles.h"

#include <span>
#include <vector>

namespace gnomon::culling {

/// A light that is seen as a disc.
struct DiscLight {
    glm::dvec3 towards{0, 1, 0}; // its middle: unit, local space
    double slope = 0;            // width of a penumbra over the distance from what throws it: 2 tan(angle / 2)
};

/// An image, its tiles, and what is seen where: at (x, y) from -1 to 1 across it the points p with
/// dot(right, p - eye) = x half.x d and dot(up, p - eye) = y half.y d, d being their depth, or 1 where lines of sight
/// are parallel. Nothing is nearer than `nearest`.
struct TiledView {
    shadow::ImageTiles tiles;
    glm::dvec2 half{1};
    bool isParallel = false;
    double nearest = 0;
};

/// An upper bound, by tile of the image, of how wide the penumbrae are, in pixels across the beam, that clusters of
/// `casters` throw on those of `image`: by the distance along the light between the box of a cluster and that of a
/// triangle that shows the eye a side that the light may reach, where the one may stand in the beams that reach the
/// other, and by the triangle's least depth; a pixel may be sampled up to half a pixel beside its middle. All lists are
/// draw lists of `query`. 0 where no box stands before such a triangle.
std::vector<double> penumbraWidths(
    const selection::CutQuery& query,
    const selection::DrawList& image,
    std::span<const selection::DrawList> casters,
    const DiscLight& light,
    const TiledView& seen);

} // namespace gnomon::culling
