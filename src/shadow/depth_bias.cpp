#include "shadow/depth_bias.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

namespace {

constexpr double kLeastCosine = 0.1;
constexpr double kRounding = 4 * 0x1.0p-24; // four units in the last place of a float depth just under 1

/// The normal that a lookup uses: tilted back towards the light to at least the least cosine.
glm::dvec3 cappedNormal(const glm::dvec3& normal, const glm::dvec3& towardsLight, double leastCosine) {
    const double cosine = glm::dot(normal, towardsLight);
    if (cosine >= leastCosine) return normal;
    const glm::dvec3 across = normal - towardsLight * cosine;
    return glm::normalize(across) * std::sqrt(1 - leastCosine * leastCosine) + towardsLight * leastCosine;
}

} // namespace

double reachTexels(double filterTexels) {
    return 0.5 + filterTexels / 2 + 1.0 / 256;
}

double largestRawBias(const LightFit& fit, double kappa, const Resolution& texels, double filterTexels) {
    // With y = -(a x + b z) on the steepest plane, a^2 + b^2 = (1 - c^2)/c^2. A step of one texel in s moves x by W w,
    // one in t moves zeta by d w^2/(1 + kappa d) and x by kappa u times that; rawDepth = -y / w. Each factor at its
    // largest over the region.
    const double steepest = std::sqrt(1 - kLeastCosine * kLeastCosine) / kLeastCosine;
    const WarpedExtent extent = warpedExtent(fit, kappa);
    const double u = std::max(std::abs(extent.min), std::abs(extent.max));
    double raw = 0;
    for (const FitPoint& point : fit.points())
        raw = std::max(raw, std::abs(point.y) / (1 + kappa * point.zeta));
    const double stepS = extent.width() / texels.s;
    const double stepT = fit.length / texels.t;
    const double perTexel = steepest * (stepS + (1 + kappa * u) * stepT) + kappa * raw * stepT;
    return reachTexels(filterTexels) * (perTexel + kUnevenSlope * std::hypot(stepS, stepT));
}

TexelDepth texelDepth(const WarpedMap& map, const Resolution& texels) {
    // A texel is W w / res_s wide and d w^2 / ((1 + kappa d) res_t) long; depth changes by 1 / (w range) a unit of
    // length along the light.
    const double stepT = map.length / (1 + map.kappa * map.length) / texels.t;
    return {map.width / texels.s / map.rawRange, stepT / map.rawRange};
}

double depthBias(const DepthBias& bias, const LightFrame& frame, const glm::dvec3& p, const glm::dvec3& normal) {
    const glm::dvec3 receiver = cappedNormal(normal, frame.y, bias.leastCosine);
    const glm::dvec4 plane = bias.textureFromCameraPlane * glm::dvec4(receiver, -glm::dot(receiver, p));
    const double uneven = std::hypot(bias.unevenX, bias.unevenZ * glm::dot(bias.wPlane, glm::dvec4(p, 1)));
    return std::abs(plane.x / plane.z) * bias.reachS + std::abs(plane.y / plane.z) * bias.reachT + uneven +
           bias.rounding;
}

DepthBias depthBiasOf(
    const glm::dmat4& textureFromCamera, int width, int height, const TexelDepth& texel, double filterTexels) {
    DepthBias bias;
    bias.unevenX = kUnevenSlope * texel.x * reachTexels(filterTexels);
    bias.unevenZ = kUnevenSlope * texel.z * reachTexels(filterTexels);
    bias.wPlane = glm::transpose(textureFromCamera)[3];
    bias.textureFromCameraPlane = glm::transpose(glm::inverse(textureFromCamera));
    bias.reachS = reachTexels(filterTexels) / width;
    bias.reachT = reachTexels(filterTexels) / height;
    bias.rounding = kRounding;
    bias.leastCosine = kLeastCosine;
    return bias;
}

} // namespace gnomon::shadow
