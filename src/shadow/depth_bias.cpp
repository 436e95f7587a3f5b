#include "shadow/depth_bias.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

double reachTexels(double filterTexels) {
    return std::max(1.0, filterTexels) / 2 + 1.0 / 256;
}

double largestRawBias(const LightFit& fit, double kappa, const Resolution& texels, double filterTexels) {
    // With y = -(a x + b z) on the steepest plane, a^2 + b^2 = (1 - c^2)/c^2. A step of one texel in s moves x by W w,
    // one in t moves zeta by d w^2/(1 + kappa d) and x by kappa u times that, and what the frame leans; rawDepth = -y /
    // w. Each factor at its largest over the region. Below the least cosine the slope times cosine / least cosine comes
    // to 1 / least cosine.
    constexpr double kSteepest = 1 / kLeastCosine;
    const WarpedExtent extent = warpedExtent(fit, kappa);
    const double u = std::max(std::abs(extent.min), std::abs(extent.max));
    const double shear = kappa * u + std::abs(lean(fit.frame));
    double raw = 0;
    for (const FitPoint& point : fit.points())
        raw = std::max(raw, std::abs(point.y) / (1 + kappa * point.zeta));
    const double stepS = extent.width() / texels.s;
    // With logarithmic rows the last is the same everywhere, but for what it grows by over the reach.
    const bool isEven = fit.rows == RowSpacing::Even || kappa == 0;
    const double steps = reachTexels(filterTexels) * std::log1p(kappa * fit.length) / texels.t;
    const double stepT =
        (isEven ? fit.length : rowLength(kappa, fit.length, fit.rows) * std::expm1(steps) / steps) / texels.t;
    const double perTexel = kSteepest * (stepS + (1 + shear) * stepT) + kappa * raw * stepT;
    return reachTexels(filterTexels) *
           (perTexel + kUnevenSlope * std::hypot(stepS, stepT * std::hypot(1, lean(fit.frame))));
}

TexelDepth texelDepth(const WarpedMap& map, const Resolution& texels) {
    // A texel is W w / res_s wide and d w^2 / ((1 + kappa d) res_t) long; depth changes by 1 / (w range) a unit of
    // length along the light.
    const double stepT = rowLength(map.kappa, map.length, map.rows) / texels.t * std::hypot(1, lean(map.frame));
    return {map.width / texels.s / map.rawRange, stepT / map.rawRange};
}

} // namespace gnomon::shadow
