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
    // The conversion from camera axes has rounding errors. They must not influence the choice between two world axes
    // with equal angles to the light.
    constexpr double kAsFar = 1e-9;
    const glm::dvec3 a = glm::abs(toWorld(anchor.basis, towardsLight));
    const bool isZMin = a.z <= a.x + kAsFar && a.z <= a.y + kAsFar;
    const bool isXMin = a.x <= a.y + kAsFar;
    const glm::dvec3 axis = isZMin ? glm::dvec3(0, 0, 1) : isXMin ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return lightFrameAlong(towardsLight, gnomon::toCamera(anchor.basis, axis));
}

LightFrame stableWorldFrame(const glm::dvec3& towardsLight) {
    const CameraBasis basis; // any basis gives the same result
    const LightFrame seen = stableFrame({basis, {}}, gnomon::toCamera(basis, towardsLight));
    return {toWorld(basis, seen.x), toWorld(basis, seen.y), toWorld(basis, seen.z)};
}

StablePlace stablePlace(
    const WorldAnchor& anchor, const LightFrame& frame, const ViewFrustum& slice, int texels, double bias) {
    GNOMON_CHECK_OP(texels, >=, 2);
    StablePlace place;
    place.texel = stableExtent(slice) / (texels - 1);
    place.texels = texels;
    place.bias = bias;
    const LightFit fit = fitSlice(frame, slice);
    const glm::dvec3 eye = toLight(frame, gnomon::toCamera(anchor.basis, anchor.eye));
    double high = fit.points().front().y;
    for (const FitPoint& point : fit.points())
        high = std::max(high, point.y);
    const auto snapped = [&](double low) { return static_cast<std::int64_t>(std::floor(low / place.texel)); };
    place.corner = {snapped(warpedExtent(fit, 0).min + eye.x), snapped(-high - eye.y), snapped(fit.zMin + eye.z)};
    return place;
}

WarpedMap stableMap(const StablePlace& place, const LightFrame& frame, const glm::dvec3& origin) {
    const auto along = [&](std::size_t axis) { return static_cast<double>(place.corner[axis]) * place.texel; };
    WarpedMap map;
    map.frame = frame;
    map.kappa = 0;
    map.width = place.texel * place.texels;
    map.length = place.texel * place.texels;
    map.uMin = along(0) - origin.x;
    map.zMin = along(2) - origin.z;
    map.rawMin = along(1) + origin.y - place.bias;
    map.rawRange = place.texel * place.texels + 2 * place.bias;
    return map;
}

} // namespace gnomon::shadow
