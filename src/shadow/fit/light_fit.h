// What one map is fitted to: the vertices of a convex part of the view frustum as the light sees them, and the
// aliasing that a warp kappa gives over them.
#pragma once

#include "shadow/fit/light_frame.h"
#include "shadow/fit/overhead.h"
#include "shadow/fit/view_frustum.h"

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::shadow {

/// Where along the slice a vertex lies.
enum class DepthEnd : std::uint8_t {
    Near,
    Far,
    Between,
    Unpromised, // of what the map covers beyond the slice: it counts for the map's extent, and for no error
};

/// A vertex of the fitted region in camera space.
struct FitVertex {
    glm::dvec3 position{0};
    DepthEnd end = DepthEnd::Between;
};

/// A vertex of the fitted region in light space. The light-space x is measured from the eye, through which the axis of
/// every warp passes; zeta is z less its minimum over the region.
struct FitPoint {
    double x = 0;
    double y = 0;
    double zeta = 0;
    double depth = 0; // view depth, p.v
    DepthEnd end = DepthEnd::Between;
};

/// How the rows of a map lie along its t axis.
enum class RowSpacing : std::uint8_t {
    Even,        // in the plane that the warp projects to
    Logarithmic, // evenly in ln w: each is by the same factor further from the warp's centre than the one before
};

/// A fitted region: what all warp rules and error measures need to know of it.
struct LightFit {
    static constexpr std::size_t kCapacity = 48;

    LightFrame frame;
    ViewFrustum slice;
    RowSpacing rows = RowSpacing::Even; // of the map that the region is fitted for
    double zMin = 0;                    // the light-space z where zeta is 0
    double length = 0;                  // d: the largest zeta
    std::size_t count = 0;
    std::array<FitPoint, kCapacity> storage{};

    std::span<const FitPoint> points() const { return {storage.data(), count}; }

    /// The part of d that the slice itself takes, without what the map covers beyond it.
    double promisedLength() const;
};

/// The region of at most LightFit::kCapacity `vertices` seen in `frame`; `slice` gives image beams and depth ends.
LightFit fitRegion(const LightFrame& frame, const ViewFrustum& slice, std::span<const FitVertex> vertices);

/// A whole slice of the frustum, seen in `frame`: its eight corners.
LightFit fitSlice(const LightFrame& frame, const ViewFrustum& slice);

/// The same region in a frame rolled about the light by `radians`, as shadow::rolled does.
LightFit rolled(const LightFit& fit, double radians);

/// The extent of u = x / (1 + kappa zeta) over the region; W = max - min. Tight, not symmetric.
struct WarpedExtent {
    double min = 0;
    double max = 0;

    double width() const { return max - min; }
};

WarpedExtent warpedExtent(const LightFit& fit, double kappa);

/// w_lz where w is 1, of a map of one row over the length `length`: d / (1 + kappa d) of even rows, whose w_lz grows
/// with w^2, and ln(1 + kappa d) / kappa of logarithmic ones, whose w_lz grows with w.
double rowLength(double kappa, double length, RowSpacing rows);

/// M_x and M_z over the region's promised part at unit resolutions (res_i = res_s = res_t = 1). The vertices suffice:
/// both measures are quasi-convex over the region (affine over affine, and affine squared over affine).
Aliasing worstAliasing(const LightFit& fit, double kappa);

/// S = M_x M_z at unit resolutions.
double storageFactor(const LightFit& fit, double kappa);

/// The largest m_t over the region's promised part when the shear of the texel is counted: m_z sqrt(1 + (kappa u)^2).
/// It lies at a vertex as long as |kappa u| <= sqrt(2) (then w sqrt(w^2 + (kappa x)^2) is convex); beyond that the
/// product of the two maxima is returned, which is never too small. With logarithmic rows it always lies at a vertex:
/// m_t is sqrt(w^2 + (kappa x)^2) / depth, a norm of something affine over something affine.
double worstShearedAliasing(const LightFit& fit, double kappa);

} // namespace gnomon::shadow
