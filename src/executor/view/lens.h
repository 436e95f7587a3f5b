// How the image is seen: where its lines of sight begin and run, and what the depths mean that it stores.
#pragma once

#include "core/camera.h"
#include "core/depth_span.h"

#include <limits>

namespace gnomon::executor {

struct FrameDrawing;

/// What a depth that an image stores means. Depths are reversed: 1 is near, 0 is where nothing was drawn.
struct ImageDepth {
    bool isParallel = false;
    DepthSpan clip;          // from the eye; of lines of sight that part only `near` counts
    double eyeMovedBack = 0; // see plan::View

    /// From the eye that draws; infinite where nothing was drawn.
    double fromEye(float stored) const {
        if (!(stored > 0)) return std::numeric_limits<double>::infinity();
        return isParallel ? clip.far - double{stored} * (clip.far - clip.near) : clip.near / double{stored};
    }

    /// What is stored of a depth from the eye that draws.
    float stored(double depth) const {
        return static_cast<float>(isParallel ? (clip.far - depth) / (clip.far - clip.near) : clip.near / depth);
    }

    /// From the eye that was asked for; likewise.
    double asked(float stored) const { return fromEye(stored) - eyeMovedBack; }
};

/// Lines of sight through an image point (x, y), each from -1 to 1, in camera space: from the eye with the direction
/// (x half.x, y half.y, 1), or from there along the view where they are parallel.
struct Lens {
    CameraBasis basis;
    glm::dvec3 eye{0}; // draw space
    glm::dvec2 half{1};
    ImageDepth depth;

    /// Clip space of the image from camera space; image points move by `moved`.
    glm::dmat4 clipFromCamera(const glm::dvec2& moved) const;

    /// The point at `depth` from the eye that is seen at (x, y), in camera space.
    glm::dvec3 seenAt(const glm::dvec2& point, double depthFromEye) const;
};

/// The lens of an image of `frame`: of its plan's camera, or of the observer.
Lens lensOf(const FrameDrawing& frame);

} // namespace gnomon::executor
