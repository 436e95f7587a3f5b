// The region that one map covers, seen from the light, and the aliasing that a warp kappa causes over this region.
#pragma once

#include "shadow/fit/light_frame.h"
#include "shadow/fit/overhead.h"
#include "shadow/fit/view_frustum.h"

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::shadow {

/// The position of a vertex along the depth of the slice.
enum class DepthEnd : std::uint8_t {
    Near,
    Far,
    Between,
    WithoutBound, // in the covered part outside the slice: counts for the map's extent, not for aliasing
};

/// A vertex of the fitted region, in camera space.
struct FitVertex {
    glm::dvec3 position{0};
    DepthEnd end = DepthEnd::Between;
};

/// A vertex of the fitted region, in light space. The coordinate x is measured from the eye, because the axis of each
/// warp passes through the eye. zeta is z minus the minimum z of the region.
struct FitPoint {
    double x = 0;
    double y = 0;
    double zeta = 0;
    double depth = 0; // view depth
    DepthEnd end = DepthEnd::Between;
};

/// The spacing of a map's rows along its t axis.
enum class RowSpacing : std::uint8_t {
    Even,        // constant in the projection plane of the warp
    Logarithmic, // constant in ln w: the distance to the warp's centre grows by the same factor per row
};

/// A fitted region: the input of all warp rules and error measures.
struct LightFit {
    static constexpr std::size_t kCapacity = 48;

    LightFrame frame;
    ViewFrustum slice;
    RowSpacing rows = RowSpacing::Even; // row spacing of the region's map
    double zMin = 0;                    // light-space z at zeta = 0
    double length = 0;                  // d: the largest zeta
    std::size_t count = 0;
    std::array<FitPoint, kCapacity> storage{};

    std::span<const FitPoint> points() const { return {storage.data(), count}; }

    /// Returns the extent in z of the slice alone, without the covered part outside the slice.
    double boundedLength() const;
};

/// Fits a region with the given `vertices` (at most LightFit::kCapacity) in the light-space axes `frame`. `slice` gives
/// the image beams and the near and far depths.
LightFit fitRegion(const LightFrame& frame, const ViewFrustum& slice, std::span<const FitVertex> vertices);

/// Fits a whole slice of the frustum in `frame`, from its eight corners.
LightFit fitSlice(const LightFrame& frame, const ViewFrustum& slice);

/// Returns the same region in a frame that is rotated about the light by `radians`, from z towards x.
LightFit rolled(const LightFit& fit, double radians);

/// The interval of u = x / (1 + kappa zeta) over the region; W = max - min. The interval is tight and not symmetric.
struct WarpedExtent {
    double min = 0;
    double max = 0;

    double width() const { return max - min; }
};

WarpedExtent warpedExtent(const LightFit& fit, double kappa);

/// Returns w_lz at w = 1 for a map with one row over the length `length`. The result is d / (1 + kappa d) for even
/// rows, whose w_lz grows with w^2. It is ln(1 + kappa d) / kappa for logarithmic rows, whose w_lz grows with w.
double rowLength(double kappa, double length, RowSpacing rows);

/// Returns M_x and M_z, the largest aliasing over the region without its vertices of kind WithoutBound, at unit
/// resolutions (res_i = res_s = res_t = 1). The function tests only the vertices, because both measures are
/// quasi-convex over the region (affine or squared affine, divided by affine).
Aliasing worstAliasing(const LightFit& fit, double kappa);

/// Returns the storage factor S = M_x M_z at unit resolutions.
double storageFactor(const LightFit& fit, double kappa);

/// Returns the largest m_t, the aliasing along t with the shear of the texel: m_z sqrt(1 + (kappa u)^2). The region
/// counts without its vertices of kind WithoutBound. The maximum lies at a vertex if |kappa u| <= sqrt(2), because w
/// sqrt(w^2 + (kappa x)^2) is then convex. Otherwise the function returns the product of the two maxima, which is an
/// upper bound. With logarithmic rows the maximum always lies at a vertex: m_t is sqrt(w^2 + (kappa x)^2) / depth, the
/// norm of an affine function divided by an affine function.
double worstShearedAliasing(const LightFit& fit, double kappa);

} // namespace gnomon::shadow
