// The projection of the image: primary rays, and the conversion of stored depths to view depths.
#pragma once

#include "core/camera.h"
#include "core/depth_span.h"

#include <limits>

namespace gnomon::render {

struct DrawInputs;

/// Converts between the stored depths of an image and view depths. Stored depth is reversed: 1 is nearest, and 0 means
/// that nothing was drawn.
struct ImageDepth {
    bool isParallel = false;
    DepthSpan clip;          // depths of the clip planes from the eye; a perspective image uses only `near`
    double eyeMovedBack = 0; // see plan::View

    /// Converts a stored depth to the view depth from the eye that draws the image. Returns infinity if nothing was
    /// drawn.
    double fromEye(float stored) const {
        if (!(stored > 0)) return std::numeric_limits<double>::infinity();
        return isParallel ? clip.far - double{stored} * (clip.far - clip.near) : clip.near / double{stored};
    }

    /// Converts a view depth from the eye that draws the image to a stored depth.
    float stored(double depth) const {
        return static_cast<float>(isParallel ? (clip.far - depth) / (clip.far - clip.near) : clip.near / depth);
    }

    /// Converts a stored depth to the view depth from the eye that the user requested. Returns infinity if nothing was
    /// drawn.
    double asked(float stored) const { return fromEye(stored) - eyeMovedBack; }
};

/// The projection of an image. It defines the primary ray through the image point (x, y) in camera space, with x and y
/// from -1 to 1. In perspective, the ray starts at the eye and has the direction (x half.x, y half.y, 1). In an
/// orthographic projection, the ray starts at the offset (x half.x, y half.y) from the eye and is parallel to the view
/// direction.
struct ImageProjection {
    CameraBasis basis;
    glm::dvec3 eye{0}; // camera-relative space
    glm::dvec2 half{1};
    ImageDepth depth;

    /// Returns the matrix from camera space to the clip space of the image. The image is shifted by `moved`.
    glm::dmat4 clipFromCamera(const glm::dvec2& moved) const;

    /// Returns the point in camera space that is visible at `point` of the image, at the depth `depthFromEye` from the
    /// eye.
    glm::dvec3 visiblePoint(const glm::dvec2& point, double depthFromEye) const;
};

/// Returns the projection of the image of `frame`, for the plan's camera or for the observer camera.
ImageProjection imageProjection(const DrawInputs& frame);

} // namespace gnomon::render
