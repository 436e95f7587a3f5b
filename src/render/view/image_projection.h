// The projection of the image: its primary rays, and the conversion of its stored depths.
#pragma once

#include "core/camera.h"
#include "core/depth_span.h"

#include <limits>

namespace gnomon::render {

struct DrawInputs;

/// Converts the stored depths of an image. Depth is reversed: 1 is nearest, and 0 means that nothing was drawn.
struct ImageDepth {
    bool isParallel = false;
    DepthSpan clip;          // depths of the clip planes from the eye; a perspective image uses only `near`
    double eyeMovedBack = 0; // see plan::View

    /// Returns the view depth from the drawing eye for a stored depth, or infinity if nothing was drawn.
    double fromEye(float stored) const {
        if (!(stored > 0)) return std::numeric_limits<double>::infinity();
        return isParallel ? clip.far - double{stored} * (clip.far - clip.near) : clip.near / double{stored};
    }

    /// Returns the stored depth for a view depth from the drawing eye.
    float stored(double depth) const {
        return static_cast<float>(isParallel ? (clip.far - depth) / (clip.far - clip.near) : clip.near / depth);
    }

    /// Returns the view depth from the requested eye for a stored depth, or infinity if nothing was drawn.
    double asked(float stored) const { return fromEye(stored) - eyeMovedBack; }
};

/// The projection of an image. It defines the primary ray through the image point (x, y), both from -1 to 1, in camera
/// space. In perspective, the ray starts at the eye and has the direction (x half.x, y half.y, 1). In an orthographic
/// projection, the ray starts at the offset (x half.x, y half.y) from the eye and is parallel to the view direction.
struct ImageProjection {
    CameraBasis basis;
    glm::dvec3 eye{0}; // camera-relative space
    glm::dvec2 half{1};
    ImageDepth depth;

    /// Returns the matrix from camera space to the clip space of the image. Image points are shifted by `moved`.
    glm::dmat4 clipFromCamera(const glm::dvec2& moved) const;

    /// Returns the point in camera space that is visible at the image point `point`, at the depth `depthFromEye` from
    /// the eye.
    glm::dvec3 visiblePoint(const glm::dvec2& point, double depthFromEye) const;
};

/// Returns the projection of the image of `frame`, for the plan's camera or the observer camera.
ImageProjection imageProjection(const DrawInputs& frame);

} // namespace gnomon::render
