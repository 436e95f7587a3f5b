// The shadow maps of a point light: one perspective map per face of a cube around the light. A face without receivers
// has no map.
#pragma once

#include "shadow/setup.h"

namespace gnomon::shadow {

/// The camera and the position of a point light, for which shadow maps are set up.
struct LampView {
    glm::dvec3 light{0};               // camera space
    CameraBasis basis;                 // axes of camera space
    ViewFrustum frustum;               // near and far bound the depths in which shadow aliasing has an upper bound
    DepthSpan shown;                   // view depths of all receivers
    int imageHeight = 800;             // pixels
    std::span<const VisibleSlab> seen; // visible slabs; empty: surfaces can be anywhere within `shown`
};

/// Returns the shadow maps of a point light, packed into one texture: one map per cube face that has receivers. The
/// texels are distributed such that all maps have the same aliasing bound (Lloyd et al. 2006, Eqs 13 and 14).
///
/// A texel of a face has the width (tangent / texels) per unit of distance along the face's axis. A pixel has the width
/// 2 tan(theta) / height per unit of view depth. The aliasing bound of a map is the max ratio of these widths, for
/// texels parallel to the face. This bound is a constant times the max ratio of the two distances, over the visible
/// points of the face within [near, far]. As a ratio of linear functions, it has its max at a corner. The function
/// evaluates the ratio for boxes around the visible points, each with its smallest view depth.
///
/// The function uses texels, filterTexels, minSide and maxSide of `options`. Throws the same errors as shadowMapSetup.
ShadowMapSetup cubeMapSetup(const LampView& view, const ShadowOptions& options);

} // namespace gnomon::shadow
