// Computes the region that one shadow map covers, seen from the light, and the aliasing that a perspective warp with
// parameter kappa causes in this region.
#pragma once

#include "shadow/fit/light_frame.h"
#include "shadow/fit/overhead.h"
#include "shadow/fit/view_frustum.h"

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::shadow {

/// The position of a region's vertex within the depth range of its slice.
enum class DepthEnd : std::uint8_t {
    Near,
    Far,
    Between,
    WithoutBound, // outside the slice's depth range: counts for the map's extent, but not for its aliasing
};

/// A vertex of the region that a shadow map must cover, in camera space.
struct FitVertex {
    glm::dvec3 position{0};
    DepthEnd end = DepthEnd::Between;
};

/// A vertex of the region that a shadow map must cover, in light space. The coordinate x is relative to the eye,
/// because the axis of each warp passes through the eye. zeta is z minus the min z of the region.
struct FitPoint {
    double x = 0;
    double y = 0;
    double zeta = 0;
    double depth = 0; // view depth
    DepthEnd end = DepthEnd::Between;
};

/// The spacing of a shadow map's rows along its t axis.
enum class RowSpacing : std::uint8_t {
    Even,        // constant in the projection plane of the warp
    Logarithmic, // constant in ln w: the distance to the warp's centre grows by the same factor per row
};

/// The region that a shadow map covers, in light space: the input of all warp rules and aliasing measures.
struct LightFit {
    static constexpr std::size_t kCapacity = 48;

    LightFrame frame;
    ViewFrustum slice;
    RowSpacing rows = RowSpacing::Even; // row spacing of the shadow map
    double zMin = 0;                    // light-space z where zeta is 0
    double length = 0;                  // max zeta of the region; d in the formulas
    std::size_t count = 0;
    std::array<FitPoint, kCapacity> storage{};

    std::span<const FitPoint> points() const { return {storage.data(), count}; }

    /// Returns the length along light-space z of the part of the region whose depths have an aliasing bound.
    double boundedLength() const;
};

/// Converts the region with the given `vertices` (at most LightFit::kCapacity) to the light-space axes `frame`. `slice`
/// defines the beams of the image pixels, and the near and far depths.
LightFit fitRegion(const LightFrame& frame, const ViewFrustum& slice, std::span<const FitVertex> vertices);

/// Converts a whole slice of the view frustum to the light-space axes `frame`, from the eight corners of the slice.
LightFit fitSlice(const LightFrame& frame, const ViewFrustum& slice);

/// Returns the region `fit` in light-space axes that are rotated about the light by `radians`, from z towards x.
LightFit rolled(const LightFit& fit, double radians);

/// The range of the projected coordinate u = x / (1 + kappa zeta) over a region, and its width W = max - min. The range
/// is tight, so it is not symmetric.
struct WarpedExtent {
    double min = 0;
    double max = 0;

    double width() const { return max - min; }
};

WarpedExtent warpedExtent(const LightFit& fit, double kappa);

/// Returns w_lz, the length of one row at w = 1 if a single row covers the length `length` (d) of a map. For even rows,
/// the result is d / (1 + kappa d), and the real length grows with w^2. For logarithmic rows, the result is ln(1 +
/// kappa d) / kappa, and the real length grows with w.
double rowLength(double kappa, double length, RowSpacing rows);

/// Returns the max perspective aliasing M_x and M_z over the region for the warp `kappa`, at unit resolutions (res_i =
/// res_s = res_t = 1). Vertices of kind WithoutBound do not count. The function tests only the vertices, because both
/// measures are quasi-convex over the region: they are affine or squared affine functions divided by an affine
/// function.
Aliasing worstAliasing(const LightFit& fit, double kappa);

/// Returns the storage factor S = M_x M_z of a map with the warp `kappa`: the texels per pixel that an aliasing of 1
/// requires.
double storageFactor(const LightFit& fit, double kappa);

/// Returns the max m_t over the region: the aliasing along t including the shear of the texel, m_z sqrt(1 + (kappa
/// u)^2). Vertices of kind WithoutBound do not count. If |kappa u| <= sqrt(2), the maximum is at a vertex, because w
/// sqrt(w^2 + (kappa x)^2) is then convex. Otherwise the function returns the product of the maxima of both factors,
/// which is an upper bound. With logarithmic rows, the maximum is always at a vertex. Then m_t is sqrt(w^2 + (kappa
/// x)^2) / depth, which is the norm of an affine function divided by an affine function.
double worstShearedAliasing(const LightFit& fit, double kappa);

} // namespace gnomon::shadow
