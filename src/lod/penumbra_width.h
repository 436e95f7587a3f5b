// The max width of penumbrae in a view. The plan uses it to find tiles where the light's disc is visible in shadows.
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

/// An image with its tiles and its projection. The image position (x, y), each from -1 to 1, shows the points p with
/// dot(right, p - eye) = x half.x d and dot(up, p - eye) = y half.y d. Here d is the depth of p, or 1 for a parallel
/// projection. No point is nearer than `nearest`.
struct TiledView {
    shadow::ImageTiles tiles;
    glm::dvec2 half{1};
    bool isParallel = false;
    double nearest = 0;
};

/// Returns an upper bound of the width of penumbrae per tile of the image, in pixels perpendicular to the beam.
/// Clusters of `casters` throw the penumbrae on clusters of `image`; all lists are draw lists of `query`.
///
/// The bound uses the distance along the light between the box of a caster and the box of a triangle. The triangle must
/// show the eye a side that the light can reach, and the caster must intersect the beams to it. The bound also uses the
/// smallest depth of the triangle. A sample of a pixel can be up to half a pixel from its centre. The result is 0 if no
/// box lies in front of such a triangle.
std::vector<double> penumbraWidths(
    const lod::CutQuery& query,
    const lod::DrawList& image,
    std::span<const lod::DrawList> casters,
    const DiscLight& light,
    const TiledView& seen);

} // namespace gnomon::lod
