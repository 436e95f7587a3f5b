#include "shadow/fit/overhead.h"

#include <cmath>
#include <limits>

namespace gnomon::shadow {

namespace {

constexpr double kNoWarp = std::numeric_limits<double>::infinity();

/// Returns n' / (n' + length), which is 1 for an infinite n' (the plain expression would be NaN).
double overFar(double nPrime, double length) {
    return std::isinf(nPrime) ? 1.0 : nPrime / (nPrime + length);
}

double worstZ(const ViewFrustum& frustum, double nPrime) {
    const double length = frustum.far - frustum.near;
    const double scale = length / (2 * tanHalfY(frustum));
    if (nPrime > nPrimeLspsm(frustum)) return scale * overFar(nPrime, length) / frustum.near;
    return scale / (overFar(nPrime, length) * frustum.far);
}

} // namespace

double nPrimeLspsm(const ViewFrustum& frustum) {
    return frustum.near + std::sqrt(frustum.far * frustum.near);
}

Aliasing aliasingOverhead(const ViewFrustum& frustum, double nPrime, double depth, const Resolution& resolution) {
    const double length = frustum.far - frustum.near;
    const double kappa = std::isinf(nPrime) ? 0.0 : 1 / nPrime;
    const double growth = 1 + kappa * (depth - frustum.near);
    const double growthFar = 1 + kappa * length;
    Aliasing result;
    result.x = resolution.image / resolution.s * frustum.far * growth / (depth * growthFar);
    result.z =
        resolution.image / resolution.t * length / (2 * tanHalfY(frustum)) * growth * growth / (depth * growthFar);
    return result;
}

Aliasing worstAliasingOverhead(const ViewFrustum& frustum, double nPrime) {
    const double length = frustum.far - frustum.near;
    return {frustum.depthRatio() * overFar(nPrime, length), worstZ(frustum, nPrime)};
}

double storageFactorOverhead(const ViewFrustum& frustum, double nPrime) {
    const double length = frustum.far - frustum.near;
    const double minOverhead = length / frustum.near / (2 * tanHalfY(frustum));
    if (nPrime < frustum.near) {
        const double excess = frustum.near * (nPrime + length) / (nPrime * frustum.far);
        return minOverhead * excess * excess;
    }
    if (nPrime <= nPrimeLspsm(frustum)) return minOverhead;
    const double shrink = overFar(nPrime, length);
    return minOverhead * shrink * shrink * frustum.depthRatio();
}

double nPrimeOfEta(const ViewFrustum& frustum, double eta) {
    const double alpha = frustum.depthRatio();
    const double root = std::sqrt(alpha);
    if (eta <= -1) return kNoWarp;
    if (eta <= 0) return frustum.near * (root + 1 - eta * (alpha - 1)) / (eta + 1);
    return frustum.near * (root + 1) / (eta * root + 1);
}

double etaOfNPrime(const ViewFrustum& frustum, double nPrime) {
    // The paper uses differences of M_z, which lose all digits for a depth ratio near 1. This formula avoids the
    // differences.
    if (std::isinf(nPrime)) return -1;
    const double minOverhead = nPrimeLspsm(frustum);
    if (nPrime > minOverhead) return (minOverhead - nPrime) / (nPrime + (frustum.far - frustum.near));
    return (minOverhead - nPrime) / (nPrime * std::sqrt(frustum.depthRatio()));
}

double nPrimeTsm(const ViewFrustum& frustum, double focus, double fraction) {
    const double length = frustum.far - frustum.near;
    const double room = fraction * length - focus;
    return room > 0 ? (1 - fraction) * length * focus / room : kNoWarp;
}

BudgetOverhead budgetOverhead(const ViewFrustum& frustum, double nPrime, double texels, double imagePixels) {
    const Aliasing unit = worstAliasingOverhead(frustum, nPrime);
    BudgetOverhead result;
    result.criticalS = imagePixels * unit.x;
    result.criticalT = imagePixels * unit.z;
    result.s = std::sqrt(texels * result.criticalS / result.criticalT);
    result.t = std::sqrt(texels * result.criticalT / result.criticalS);
    result.worst = {result.criticalS / result.s, result.criticalT / result.t};
    return result;
}

} // namespace gnomon::shadow
