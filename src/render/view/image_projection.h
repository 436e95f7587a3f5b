// The projection of the image: the primary rays, and the meaning of stored depths.
#pragma once

#include "core/camera.h"
#include "core/depth_span.h"

#include <limits>

namespace gnomon::render {

struct DrawInputs;

/// The meaning of a stored depth. Depth is reversed: 1 is near, and 0 means that nothing was drawn.
struct ImageDepth {
    bool isParallel = false;
    DepthSpan clip;          // from the eye; a perspective image uses only `near`
    double eyeMovedBack = 0; // see plan::View

    /// Returns the depth from the drawing eye, or infinity if nothing was drawn.
    double fromEye(float stored) const {
        if (!(stored > 0)) return std::numeric_limits<double>::infinity();
        return isParallel ? clip.far - double{stored} * (clip.far - clip.near) : clip.near / double{stored};
    }

    /// Returns the stored value of a depth from the drawing eye.
    float stored(double depth) const {
        return static_cast<float>(isParallel ? (clip.far - depth) / (clip.far - clip.near) : clip.near / depth);
    }

    /// Returns the depth from the requested eye, or infinity if nothing was drawn.
    double asked(float stored) const { return fromEye(stored) - eyeMovedBack; }
};

/// A projection. The primary ray through the image point (x, y), both from -1 to 1, is given in camera space. In
/// perspective it starts at the eye with the direction (x half.x, y half.y, 1). In an orthographic projection it starts
/// at this offset from the eye and runs along the view.
struct ImageProjection {
    CameraBasis basis;
    glm::dvec3 eye{0}; // camera-relative space
    glm::dvec2 half{1};
    ImageDepth depth;

    /// Returns the clip space of the image from camera space, with image points shifted by `moved`.
    glm::dmat4 clipFromCamera(const glm::dvec2& moved) const;

    /// Returns the point in camera space that is visible at (x, y) at `depth` from the eye.
    glm::dvec3 visiblePoint(const glm::dvec2& point, double depthFromEye) const;
};

/// Returns the projection of an image of `frame`, for the plan's camera or the observer.
ImageProjection imageProjection(const DrawInputs& frame);

} // namespace gnomon::render
