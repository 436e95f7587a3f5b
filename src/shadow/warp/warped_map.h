// The map from a point to (s, t, depth), with its Jacobian, and the 4x4 matrix that does the same.
#pragma once

#include "shadow/fit/light_fit.h"

#include <optional>

namespace gnomon::shadow {

/// Everything that places a point in one shadow map, s, t and depth in [0, 1] over the fitted region:
/// u = x / w, s = (u - uMin) / width, t = zeta (1 + kappa d) / (d w), depth = (rawDepth - rawMin) / rawRange with
/// w = 1 + kappa zeta and rawDepth = -y / w: 0 is nearest to the light. With logarithmic rows t = ln w / ln(1 + kappa
/// d) instead, which no matrix gives: the matrix below then gives the t of even rows, 1 - 1 / w up to a factor, of
/// which that is a function. What uses a map should use point and Jacobian.
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

/// Whether only a rasteriser that takes rows from an array can draw it.
inline bool hasLogRows(const WarpedMap& map) {
    return map.rows == RowSpacing::Logarithmic;
}

/// The map with warp `kappa` of `fit`, whose depth is fitted to its vertices, grown by `bias` (in rawDepth) at both
/// ends. Extents of zero are widened to 1e-9 of the slice's near depth, so that nothing divides by zero.
WarpedMap warpedMap(const LightFit& fit, double kappa, double bias = 0);

/// Where `p`, in camera space, lies in the map. Only meaningful where w > 0.
struct MapPoint {
    double s = 0;
    double t = 0;
    double depth = 0;
    double w = 1;
};

MapPoint mapPoint(const WarpedMap& map, const glm::dvec3& p);

/// The inverse of mapPoint without its depth: where (s, t) lies in light space, x and z; nothing from the warp's
/// vanishing line on, which logarithmic rows never reach. A grown or shrunk rectangle of a map is the hull of what
/// its corners come to: even rows are linear over linear, and a step in ln w is linear in (x, w).
std::optional<glm::dvec2> lightPlanePoint(const WarpedMap& map, double s, double t);

/// The derivatives of (s, t, depth) by camera-space position: rows are the gradients of s, t and depth.
struct MapJacobian {
    glm::dvec3 s{0};
    glm::dvec3 t{0};
    glm::dvec3 depth{0};
};

MapJacobian mapJacobian(const WarpedMap& map, const glm::dvec3& p);

/// The widths of a texel's light beam at `p` along x and along z, world units (section 4.1, without the shear term):
/// w_lx = W w / res_s and w_lz = d w^2 / ((1 + kappa d) res_t), with logarithmic rows w ln(1 + kappa d) / (kappa
/// res_t); `sheared` is the length of a whole step in t.
struct LightBeam {
    double x = 0;
    double z = 0;
    double sheared = 0;
};

LightBeam lightBeam(const WarpedMap& map, const glm::dvec3& p, const Resolution& resolution);

/// The matrix whose product with (p, 1) is (s w, t w, depth w, w), t of even rows.
glm::dmat4 textureFromCamera(const WarpedMap& map);

/// `textureFromCamera` for points given relative to `origin` in camera space. Below a depth ratio of 1.1 or a half
/// angle of a degree, float positions must be taken relative to a point inside the slice.
glm::dmat4 relativeTo(const glm::dmat4& textureFromCamera, const glm::dvec3& origin);

} // namespace gnomon::shadow
