// The part of the view that shadows are promised for, in left-handed camera space: eye at 0, right +x, up +y, view +z.
#pragma once

#include <glm/glm.hpp>

#include <array>

namespace gnomon::shadow {

/// A view frustum or one slice of it: depths `near` to `far` along +z, of an image with square pixels.
struct ViewFrustum {
    double near = 0.1;                           // > 0, world units
    double far = 1000;                           // > near
    double halfFovYRadians = 0.5235987755982988; // theta of the paper: HALF the vertical angle, in (0, pi/2)
    double aspect = 1;                           // width / height; tan(theta_x) = aspect tan(theta)

    /// alpha of the paper.
    double depthRatio() const { return far / near; }

    bool operator==(const ViewFrustum&) const = default;
};

/// tan of half the vertical and half the horizontal angle.
double tanHalfY(const ViewFrustum& frustum);
double tanHalfX(const ViewFrustum& frustum);

/// The part of `frustum` between the depths `near` and `far`.
ViewFrustum slice(const ViewFrustum& frustum, double near, double far);

/// The eight corners; bit 0 of the index is +x, bit 1 is +y, bit 2 is far.
std::array<glm::dvec3, 8> corners(const ViewFrustum& frustum);

/// The width of a pixel's image beam at view depth `depth`, world units: w_i = 2 tan(theta) depth / heightPixels
/// (Lloyd et al. 2006, Eq 2, without the paper's extra 1/n). The same on both axes, since pixels are square.
double imageBeamWidth(const ViewFrustum& frustum, double depth, double heightPixels);

/// Throws gnomon::Error unless 0 < near < far < infinity, 0 < theta < pi/2 and 0 < aspect < infinity.
void requireValid(const ViewFrustum& frustum);

} // namespace gnomon::shadow
