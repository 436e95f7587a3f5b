#include "shadow/stable_slice.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

double stableExtent(const ViewFrustum& slice) {
    const std::array<glm::dvec3, 8> points = corners(slice);
    double longest = 0;
    for (const glm::dvec3& a : points)
        for (const glm::dvec3& b : points)
            longest = std::max(longest, glm::length(a - b));
    return longest;
}

LightFrame stableFrame(const WorldAnchor& anchor, const glm::dvec3& towardsLight) {
    const glm::dvec3 a = glm::abs(toWorld(anchor.basis, towardsLight));
    const bool zLeast = a.z <= a.x && a.z <= a.y;
    const glm::dvec3 axis = zLeast ? glm::dvec3(0, 0, 1) : a.x <= a.y ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return lightFrameAlong(towardsLight, gnomon::toCamera(anchor.basis, axis));
}

WarpedMap stableMap(
    const WorldAnchor& anchor, const LightFrame& frame, const ViewFrustum& slice, int texels, double bias) {
    GNOMON_CHECK_OP(texels, >=, 2);
    const double extent = stableExtent(slice);
    const double texel = extent / (texels - 1);
    const LightFit fit = fitSlice(frame, slice);
    const glm::dvec3 eye = toLight(frame, gnomon::toCamera(anchor.basis, anchor.eye));
    const auto snapped = [&](double low, double origin) { return std::floor((low + origin) / texel) * texel - origin; };
    WarpedMap map;
    map.frame = frame;
    map.kappa = 0;
    map.width = texel * texels;
    map.length = texel * texels;
    map.uMin = snapped(warpedExtent(fit, 0).min, eye.x);
    map.zMin = snapped(fit.zMin, eye.z);
    double high = fit.points().front().y;
    for (const FitPoint& point : fit.points())
        high = std::max(high, point.y);
    map.rawMin = snapped(-high, -eye.y) - bias;
    map.rawRange = texel * texels + 2 * bias;
    return map;
}

} // namespace gnomon::shadow
