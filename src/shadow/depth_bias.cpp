#include "shadow/depth_bias.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

double reachTexels(double filterTexels) {
    return std::max(1.0, filterTexels) / 2 + 1.0 / 256;
}

double largestRawBias(const LightFit& fit, double kappa, const Resolution& texels, double filterTexels) {
    // The steepest receiver plane is y = -(a x + b z) with a^2 + b^2 = (1 - c^2)/c^2, where c is the cosine between
    // normal and light. A step of one texel in s moves x by W w. A step in t moves zeta by d w^2/(1 + kappa d). It
    // moves x by kappa u times this length plus the lean of the frame. rawDepth is -y / w. The code uses the max of
    // each factor over the region. For c below kMinCosine, the slope times c / kMinCosine is at most 1 / kMinCosine.
    constexpr double kSteepest = 1 / kMinCosine;
    const WarpedExtent extent = warpedExtent(fit, kappa);
    const double u = std::max(std::abs(extent.min), std::abs(extent.max));
    const double shear = kappa * u + std::abs(lean(fit.frame));
    double raw = 0;
    for (const FitPoint& point : fit.points())
        raw = std::max(raw, std::abs(point.y) / (1 + kappa * point.zeta));
    const double stepS = extent.width() / texels.s;
    // With logarithmic rows, stepT is constant. It only grows over the reach of the filter.
    const bool isEven = fit.rows == RowSpacing::Even || kappa == 0;
    const double steps = reachTexels(filterTexels) * std::log1p(kappa * fit.length) / texels.t;
    const double stepT =
        (isEven ? fit.length : rowLength(kappa, fit.length, fit.rows) * std::expm1(steps) / steps) / texels.t;
    const double perTexel = kSteepest * (stepS + (1 + shear) * stepT) + kappa * raw * stepT;
    return reachTexels(filterTexels) *
           (perTexel + kUnevenSlope * std::hypot(stepS, stepT * std::hypot(1, lean(fit.frame))));
}

TexelDepth texelDepth(const WarpedMap& map, const Resolution& texels) {
    // A texel has the width W w / res_s and the length d w^2 / ((1 + kappa d) res_t). Depth changes by 1 / (w range)
    // per unit of length along the light.
    const double stepT = rowLength(map.kappa, map.length, map.rows) / texels.t * std::hypot(1, lean(map.frame));
    return {map.width / texels.s / map.rawRange, stepT / map.rawRange};
}

} // namespace gnomon::shadow
