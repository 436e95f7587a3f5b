#include "shadow/warp/orientation.h"

#include "core/angle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::shadow {

namespace {

constexpr double kQuarter = kPi / 2;
constexpr int kCoarse = 24; // samples of the map's rotation over half a revolution
// another minimum of S is selected only if it is below this fraction of the current minimum
constexpr double kLowerMinimum = 0.95;

/// Returns an approximation of the storage factor S for a map rotated by `radians` from the plain orientation. The
/// approximation is fast to compute and slightly too large. For the rule Auto, it is the min S of four warps.
double roughStorage(const LightFit& plain, const Warp& warp, double radians) {
    const LightFit fit = rolled(plain, radians);
    if (rowsOf(warp.rule) == RowSpacing::Logarithmic) return storageFactor(fit, kappaLog(fit, Search::Rough));
    if (warp.rule != WarpRule::Auto) return storageFactor(fit, kappaOf(warp, fit));
    const double maxKappa = kappaMinimax(fit);
    double minStorage = storageFactor(fit, 0);
    for (const double fraction : {0.2, 0.5, 1.0})
        if (maxKappa > 0) minStorage = std::min(minStorage, storageFactor(fit, maxKappa * fraction));
    return minStorage;
}

double exactStorage(const LightFit& plain, const Warp& warp, double radians) {
    const LightFit fit = rolled(plain, radians);
    return storageFactor(fit, kappaOf(warp, fit));
}

/// Returns the rotation of the map at a local minimum of the storage factor S near `start`, within `reach` on both
/// sides.
double localMinimum(const LightFit& plain, const Warp& warp, double start, double reach) {
    double best = start;
    double minStorage = roughStorage(plain, warp, start);
    for (double step = reach / 2; step > 1e-4; step /= 2) {
        for (const double at : {best - step, best + step}) {
            const double found = roughStorage(plain, warp, at);
            if (found >= minStorage) continue;
            minStorage = found;
            best = at;
            break;
        }
    }
    return best;
}

/// Returns the rotation about the light with the smallest storage factor S, within a quarter revolution of the plain
/// orientation.
double bestLightRoll(const LightFit& plain, const Warp& warp) {
    double best = 0;
    double minStorage = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kCoarse; ++i) {
        const double at = kPi * (static_cast<double>(i) / kCoarse - 0.5);
        const double found = roughStorage(plain, warp, at);
        // Without a warp, all minima of S are equal. The smaller rotation is then selected, so that rounding has no
        // influence.
        if (found < minStorage * (1 - 1e-9) || (found < minStorage * (1 + 1e-9) && std::abs(at) < std::abs(best))) {
            minStorage = std::min(minStorage, found);
            best = at;
        }
    }
    const double refined = localMinimum(plain, warp, best, kPi / kCoarse);
    return exactStorage(plain, warp, refined) <= exactStorage(plain, warp, 0) ? refined : 0.0;
}

/// Returns the angle `radians` in [-pi, pi), without whole revolutions.
double wrapped(double radians) {
    return radians - 2 * kPi * std::floor((radians + kPi) / (2 * kPi));
}

} // namespace

glm::dvec3 carried(const OrientationState& state, const glm::dvec3& towardsLight) {
    const glm::dvec3 axis = glm::cross(state.towardsLight, towardsLight);
    const double cosine = glm::dot(state.towardsLight, towardsLight);
    glm::dvec3 z = state.zAxis;
    // This is Rodrigues' rotation formula, with sine and cosine from the two light directions. Opposite lights need no
    // rotation, because an axis perpendicular to one light is also perpendicular to the other.
    if (cosine > -0.999999) z += glm::cross(axis, z) + glm::cross(axis, glm::cross(axis, z)) / (1 + cosine);
    z -= towardsLight * glm::dot(z, towardsLight);
    return glm::normalize(z);
}

LightFrame chosenFrame(
    const ViewFrustum& slice,
    const glm::dvec3& towardsLight,
    const Warp& warp,
    const std::optional<OrientationState>& previous) {
    LightFit plain = fitSlice(lightFrame(towardsLight), slice);
    plain.rows = rowsOf(warp.rule);
    if (!previous) return rolled(plain.frame, bestLightRoll(plain, warp));
    const glm::dvec3 z = carried(*previous, towardsLight);
    const double now = std::atan2(glm::dot(z, plain.frame.x), glm::dot(z, plain.frame.z));
    const double lightAngle = std::asin(std::min(1.0, glm::length(glm::cross(previous->towardsLight, towardsLight))));
    const double reach =
        kOrientationRate * (glm::dot(previous->towardsLight, towardsLight) > 0 ? lightAngle : kPi - lightAngle);
    if (reach >= kPi) return rolled(plain.frame, bestLightRoll(plain, warp));
    double target = localMinimum(plain, warp, now, kQuarter / 6);
    const double other = bestLightRoll(plain, warp);
    if (exactStorage(plain, warp, other) < kLowerMinimum * exactStorage(plain, warp, target)) target = other;
    return rolled(plain.frame, now + std::clamp(wrapped(target - now), -reach, reach));
}

} // namespace gnomon::shadow
