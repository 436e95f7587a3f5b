// Computes the max width of penumbrae in a view. The plan uses it to find the image tiles in which penumbrae are wide
// enough to be visible.
#pragma once

#include "lod/cut.h"
#include "shadow/image_tiles.h"

#include <span>
#include <vector>

namespace gnomon::lod {

/// A light that appears as a disc.
struct DiscLight {
    glm::dvec3 towards{0, 1, 0}; // direction of its centre: unit, local space
    double slope = 0;            // width of a penumbra divided by the distance to the caster: 2 tan(angle / 2)
};

/// An image with its tiles and its projection. The image position (x, y), each from -1 to 1, shows all points p with
/// dot(right, p - eye) = x half.x d and dot(up, p - eye) = y half.y d. Here d is the depth of p in perspective, or 1
/// for a parallel projection. No visible point is nearer than `nearest`.
struct TiledView {
    shadow::ImageTiles tiles;
    glm::dvec2 half{1};
    bool isParallel = false;
    double nearest = 0;
};

/// Returns an upper bound of the width of penumbrae per image tile, in pixels perpendicular to the beam. The penumbrae
/// are thrown by the clusters in `casters` onto the clusters in `image`. All these lists are lists of drawn clusters of
/// `query`.
///
/// The bound is computed from the distance, along the light, between the box of a caster and the box of a visible
/// triangle, and from the smallest depth of the triangle. Only triangles count whose visible side the light can reach,
/// and only casters that intersect the light beams to the triangle. The tiles include a margin, because a sample can be
/// up to half a pixel from the centre of its pixel. If no caster's box is in front of a visible triangle, the result is
/// 0.
std::vector<double> penumbraWidths(
    const lod::CutQuery& query,
    const lod::DrawList& image,
    std::span<const lod::DrawList> casters,
    const DiscLight& light,
    const TiledView& seen);

} // namespace gnomon::lod
