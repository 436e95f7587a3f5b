// The view frustum for whose depth range shadow aliasing has an upper bound, in left-handed camera space: eye at 0, x
// right, y up, z along the view.
#pragma once

#include <glm/glm.hpp>

#include <array>

namespace gnomon::shadow {

/// A view frustum or one slice of it: depths `near` to `far` along +z, for an image with square pixels.
struct ViewFrustum {
    double near = 0.1;                           // > 0, world units
    double far = 1000;                           // > near
    double halfFovYRadians = 0.5235987755982988; // theta of Lloyd et al. 2006: HALF the vertical angle, in (0, pi/2)
    double aspect = 1;                           // width / height; tan(theta_x) = aspect tan(theta)

    /// Returns far / near, the alpha of Lloyd et al. 2006.
    double depthRatio() const { return far / near; }

    bool operator==(const ViewFrustum&) const = default;
};

/// tanHalfY and tanHalfX return the tangents of half the vertical and half the horizontal angle of view.
double tanHalfY(const ViewFrustum& frustum);
double tanHalfX(const ViewFrustum& frustum);

/// Returns the part of `frustum` between the depths `near` and `far`.
ViewFrustum slice(const ViewFrustum& frustum, double near, double far);

/// Returns the eight corners of `frustum`. Bit 0 of the index selects +x, bit 1 selects +y, bit 2 selects far.
std::array<glm::dvec3, 8> corners(const ViewFrustum& frustum);

/// Returns the width that one pixel covers at view depth `depth`, in world units: w_i = 2 tan(theta) depth /
/// heightPixels (Lloyd et al. 2006, Eq 2, without the paper's extra 1/n). The width is the same on both axes because
/// pixels are square.
double imageBeamWidth(const ViewFrustum& frustum, double depth, double heightPixels);

/// Throws gnomon::Error unless 0 < near < far < infinity, 0 < theta < pi/2 and 0 < aspect < infinity.
void requireValid(const ViewFrustum& frustum);

} // namespace gnomon::shadow
