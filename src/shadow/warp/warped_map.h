// Projects a point to shadow map coordinates (s, t, depth), and computes the derivatives of the projection and the
// equivalent 4x4 matrix.
#pragma once

#include "shadow/fit/light_fit.h"

#include <optional>

namespace gnomon::shadow {

/// The projection of one shadow map. The coordinates s, t and depth are in [0, 1] over the region that the map covers:
/// u = x / w, s = (u - uMin) / width, t = zeta (1 + kappa d) / (d w), depth = (rawDepth - rawMin) / rawRange
/// with w = 1 + kappa zeta and rawDepth = -y / w. Depth 0 is nearest to the light. With logarithmic rows, t = ln w /
/// ln(1 + kappa d). No matrix can express this t, so `textureFromCamera` returns the t of even rows instead. For
/// logarithmic rows, callers use mapPoint and mapJacobian.
struct WarpedMap {
    LightFrame frame;
    RowSpacing rows = RowSpacing::Even;
    double kappa = 0;
    double zMin = 0;
    double length = 0; // d
    double uMin = 0;
    double width = 0; // W
    double rawMin = 0;
    double rawRange = 1;
};

/// Returns true if the rows of `map` are logarithmic. Only a rasteriser that reads row positions from an array can draw
/// such a map.
inline bool hasLogRows(const WarpedMap& map) {
    return map.rows == RowSpacing::Logarithmic;
}

/// Returns the projection of a shadow map that covers the region `fit` with warp `kappa`. The depth range contains all
/// vertices and is extended by `bias` (in rawDepth) at both ends. Extents of zero are widened to 1e-9 of the slice's
/// near depth, to avoid a division by zero.
WarpedMap warpedMap(const LightFit& fit, double kappa, double bias = 0);

/// The shadow map coordinates of a point. They are valid only where w > 0.
struct MapPoint {
    double s = 0;
    double t = 0;
    double depth = 0;
    double w = 1;
};

MapPoint mapPoint(const WarpedMap& map, const glm::dvec3& p);

/// Returns the light-space position (x, z) of the map coordinates (s, t): the inverse of mapPoint without depth.
/// Returns nullopt if (s, t) is on or behind the vanishing line of the warp. Logarithmic rows have no vanishing line.
///
/// Any rectangle in map coordinates corresponds to the convex hull of its four transformed corners. The reason for even
/// rows is that the transformation is a linear function divided by a linear function. For logarithmic rows, a step in
/// ln w is linear in (x, w).
std::optional<glm::dvec2> lightPlanePoint(const WarpedMap& map, double s, double t);

/// The derivatives of the map coordinates (s, t, depth) with respect to the camera-space position. Each row is a
/// gradient.
struct MapJacobian {
    glm::dvec3 s{0};
    glm::dvec3 t{0};
    glm::dvec3 depth{0};
};

MapJacobian mapJacobian(const WarpedMap& map, const glm::dvec3& p);

/// The widths of a texel's light beam along x and z, in world units (Lloyd et al. 2006, section 4.1):
/// w_lx = W w / res_s and w_lz = d w^2 / ((1 + kappa d) res_t).
/// With logarithmic rows, w_lz = w ln(1 + kappa d) / (kappa res_t). `sheared` is the length of a step of one texel in
/// t, including the shear.
struct LightBeam {
    double x = 0;
    double z = 0;
    double sheared = 0;
};

LightBeam lightBeam(const WarpedMap& map, const glm::dvec3& p, const Resolution& resolution);

/// Returns the projection of `map` as a matrix. Its product with (p, 1) is (s w, t w, depth w, w). Here t is the t of
/// even rows.
glm::dmat4 textureFromCamera(const WarpedMap& map);

/// Returns the matrix `textureFromCamera` for positions relative to `origin` in camera space. Views with a depth ratio
/// below 1.1 or a half angle below one degree need this matrix, because their float positions must be relative to a
/// point inside the slice.
glm::dmat4 relativeTo(const glm::dmat4& textureFromCamera, const glm::dvec3& origin);

} // namespace gnomon::shadow
