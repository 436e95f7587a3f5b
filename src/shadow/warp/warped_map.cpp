#include "shadow/warp/warped_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::shadow {

namespace {

/// The four linear functions from which the projection of a map is computed. Each function is dot(row.xyz, light-space
/// point) + row.w.
struct LightRows {
    glm::dvec4 u{0};     // x
    glm::dvec4 zeta{0};  // z - zMin
    glm::dvec4 w{0};     // 1 + kappa zeta
    glm::dvec4 depth{0}; // -y
};

LightRows lightRows(const WarpedMap& map) {
    LightRows rows;
    rows.u = {map.frame.x, 0};
    rows.zeta = {map.frame.z, -map.zMin};
    rows.w = rows.zeta * map.kappa + glm::dvec4(0, 0, 0, 1);
    rows.depth = {-map.frame.y, 0};
    return rows;
}

double tOf(const WarpedMap& map, double zeta) {
    if (map.rows == RowSpacing::Even)
        return zeta * (1 + map.kappa * map.length) / (map.length * (1 + map.kappa * zeta));
    return std::log1p(map.kappa * zeta) / std::log1p(map.kappa * map.length);
}

} // namespace

WarpedMap warpedMap(const LightFit& fit, double kappa, double bias) {
    const double minExtent = 1e-9 * fit.slice.near;
    WarpedMap map;
    map.frame = fit.frame;
    map.rows = kappa > 0 ? fit.rows : RowSpacing::Even;
    map.kappa = kappa;
    map.zMin = fit.zMin;
    map.length = std::max(fit.length, minExtent);
    const WarpedExtent extent = warpedExtent(fit, kappa);
    map.uMin = extent.min;
    map.width = std::max(extent.width(), minExtent);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const FitPoint& point : fit.points()) {
        const double raw = -point.y / (1 + kappa * point.zeta);
        low = std::min(low, raw);
        high = std::max(high, raw);
    }
    map.rawMin = low - bias;
    map.rawRange = std::max(high - low + 2 * bias, minExtent);
    return map;
}

MapPoint mapPoint(const WarpedMap& map, const glm::dvec3& p) {
    const glm::dvec3 light = toLight(map.frame, p);
    const double zeta = light.z - map.zMin;
    MapPoint result;
    result.w = 1 + map.kappa * zeta;
    result.s = (light.x / result.w - map.uMin) / map.width;
    result.t = tOf(map, zeta);
    result.depth = (-light.y / result.w - map.rawMin) / map.rawRange;
    return result;
}

std::optional<glm::dvec2> lightPlanePoint(const WarpedMap& map, double s, double t) {
    const double warp = map.kappa * map.length;
    double zeta = 0;
    if (map.rows == RowSpacing::Even) {
        const double divisor = 1 + warp * (1 - t);
        if (!(divisor > 0)) return std::nullopt;
        zeta = t * map.length / divisor;
    } else {
        zeta = std::expm1(t * std::log1p(warp)) / map.kappa;
    }
    const double w = 1 + map.kappa * zeta;
    if (!(w > 0)) return std::nullopt;
    return glm::dvec2((map.uMin + s * map.width) * w, zeta + map.zMin);
}

MapJacobian mapJacobian(const WarpedMap& map, const glm::dvec3& p) {
    const glm::dvec3 light = toLight(map.frame, p);
    const double w = 1 + map.kappa * (light.z - map.zMin);
    const glm::dvec3 gradientOfW = map.frame.z * map.kappa;
    MapJacobian result;
    result.s = (map.frame.x - gradientOfW * (light.x / w)) / (w * map.width);
    const double growth = map.rows == RowSpacing::Even ? w * w : w;
    result.t = map.frame.z / (rowLength(map.kappa, map.length, map.rows) * growth);
    result.depth = (-map.frame.y + gradientOfW * (light.y / w)) / (w * map.rawRange);
    return result;
}

LightBeam lightBeam(const WarpedMap& map, const glm::dvec3& p, const Resolution& resolution) {
    const glm::dvec3 light = toLight(map.frame, p);
    const double w = 1 + map.kappa * (light.z - map.zMin);
    const double shear = map.kappa * light.x / w + lean(map.frame);
    LightBeam beam;
    beam.x = map.width * w / resolution.s;
    const double growth = map.rows == RowSpacing::Even ? w * w : w;
    beam.z = rowLength(map.kappa, map.length, map.rows) * growth / resolution.t;
    beam.sheared = beam.z * std::sqrt(1 + shear * shear);
    return beam;
}

glm::dmat4 textureFromCamera(const WarpedMap& map) {
    const LightRows rows = lightRows(map);
    const glm::dvec4 s = (rows.u - rows.w * map.uMin) / map.width;
    const glm::dvec4 t = rows.zeta * ((1 + map.kappa * map.length) / map.length);
    const glm::dvec4 depth = (rows.depth - rows.w * map.rawMin) / map.rawRange;
    return glm::transpose(glm::dmat4(s, t, depth, rows.w));
}

glm::dmat4 relativeTo(const glm::dmat4& textureFromCamera, const glm::dvec3& origin) {
    glm::dmat4 result = textureFromCamera;
    result[3] = textureFromCamera * glm::dvec4(origin, 1);
    return result;
}

} // namespace gnomon::shadow
