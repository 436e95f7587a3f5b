// The shadow maps of a point light: a perspective map for each face of a cube about it that anything is seen through.
#pragma once

#include "shadow/setup.h"

namespace gnomon::shadow {

/// What is looked at, and from where it is lit.
struct LampView {
    glm::dvec3 light{0};            // camera space
    CameraBasis basis;              // of that
    ViewFrustum frustum;            // near and far are the range that shadows are promised for
    DepthSpan shown;                // view depths of all that is to have shadows
    int imageHeight = 800;          // pixels
    std::span<const SeenPart> seen; // all that is seen; nothing: anything may be anywhere within `shown`
};

/// One map a face that has any receivers, packed into one texture, and so many texels each that all promise the same
/// (Lloyd et al. 2006, Eqs 13 and 14).
///
/// A texel of a face is tangent / texels wide a unit of distance along the face's axis, and a pixel is 2 tan(theta) /
/// height wide a unit of view depth. So what a map promises, the largest width of a texel, parallel to its face, over
/// that of a pixel, is a constant times the largest ratio of those two depths over what is seen through the face
/// within [near, far]: a quotient of linear functions, which is largest at a corner. It is taken of boxes that hold
/// what is seen, each over its least depth.
///
/// Uses texels, filterTexels, minSide and maxSide of `options`. Throws as shadowMapSetup.
ShadowMapSetup cubeMapSetup(const LampView& view, const ShadowOptions& options);

} // namespace gnomon::shadow
