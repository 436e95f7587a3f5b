#include "shadow/warp/warp.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::shadow {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kMaxWarp = 1e6; // max kappa d for the rules whose kappa can become infinite

/// Returns the argument with the smallest `value` in [low, high], by golden-section search to within `tolerance`. The
/// function must be unimodal. If an end of the interval is at least as good as the result, returns this end.
template <class Function>
double minimumOf(const Function& value, double low, double high, double tolerance) {
    constexpr double kGolden = 0.6180339887498949;
    double bestAt = low;
    double best = value(low);
    const auto keep = [&](double at, double found) {
        if (found < best) {
            best = found;
            bestAt = at;
        }
        return found;
    };
    keep(high, value(high));
    double a = high - kGolden * (high - low);
    double b = low + kGolden * (high - low);
    double atA = keep(a, value(a));
    double atB = keep(b, value(b));
    while (high - low > tolerance) {
        if (atA <= atB) {
            high = b;
            b = a;
            atB = atA;
            a = high - kGolden * (high - low);
            atA = keep(a, value(a));
        } else {
            low = a;
            a = b;
            atA = atB;
            b = low + kGolden * (high - low);
            atB = keep(b, value(b));
        }
    }
    return bestAt;
}

double kappaOfLog(const LightFit& fit, double logGrowth) {
    return fit.length > 0 ? std::expm1(logGrowth) / fit.length : 0.0;
}

/// Returns the storage factor S as a function of ln(1 + kappa d), the logarithm of the growth of w over the map.
auto storageOfGrowth(const LightFit& fit) {
    return [&fit](double logGrowth) { return storageFactor(fit, kappaOfLog(fit, logGrowth)); };
}

/// Returns the ln(1 + kappa d) with the smallest storage factor S, between no warp and kMaxWarp. The search evaluates
/// `steps` equal steps, and refines the best step by golden-section search between its neighbours.
double growthOfMinStorage(const LightFit& fit, int steps, double tolerance) {
    const auto storage = storageOfGrowth(fit);
    const double step = std::log1p(kMaxWarp) / steps;
    double best = storage(0);
    double bestAt = 0;
    for (int i = 1; i <= steps; ++i) {
        const double found = storage(i * step);
        if (found < best) {
            best = found;
            bestAt = i * step;
        }
    }
    return minimumOf(storage, std::max(0.0, bestAt - step), bestAt + step, tolerance);
}

} // namespace

double kappaLspsm(const LightFit& fit) {
    const double sine = sinLightAngle(fit.frame.y);
    const double near = fit.slice.near;
    return sine / (near + std::sqrt(near * (near + fit.boundedLength() * sine)));
}

double kappaTsm(const LightFit& fit, double focusZeta, double fraction) {
    const double d = fit.length;
    const double room = fraction * d - focusZeta;
    if (!(room > 0)) return 0;
    const double maxKappa = kMaxWarp / d;
    const double pole = (1 - fraction) * d * std::max(focusZeta, 0.0);
    return pole * maxKappa > room ? room / pole : maxKappa;
}

double tsmFocusDepth(const ViewFrustum& slice) {
    return std::sqrt(slice.near) * std::sqrt(slice.far);
}

Warp warpOfSlice(const Warp& warp, const ViewFrustum& whole, const ViewFrustum& slice) {
    Warp result = warp;
    if (result.tsmFocus) *result.tsmFocus *= slice.near / whole.near;
    return result;
}

double kappaMinimax(const LightFit& fit) {
    double a = 0;
    double b = 0;
    for (const FitPoint& point : fit.points()) {
        if (point.end == DepthEnd::Near) a = std::max(a, point.zeta);
        if (point.end == DepthEnd::Far) b = std::max(b, point.zeta);
    }
    const double d = fit.length;
    if (d <= 2 * a) return 0;
    const double root = std::sqrt(fit.slice.depthRatio());
    // This form of root - 1 is also precise for a depth ratio near 1.
    const double rootLessOne = (fit.slice.far - fit.slice.near) / (fit.slice.near * (root + 1));
    const double nearStops = a > 0 ? (d - 2 * a) / (a * d) : kNever;
    const double farOvertakes = b > root * a ? rootLessOne / (b - root * a) : kNever;
    // If the map covers far more than its slice, the aliasing of the far side can still fall after it has become larger
    // than the aliasing of the near side.
    const double farStops = b > 0 ? (d - 2 * b) / (b * d) : kNever;
    const double kappa = nearStops < farOvertakes ? nearStops : std::max(farOvertakes, farStops);
    return std::isfinite(kappa) ? std::min(kappa, kMaxWarp / d) : 0.0;
}

double kappaAuto(const LightFit& fit) {
    const double maxKappa = kappaMinimax(fit);
    if (!(maxKappa > 0)) return 0;
    return std::min(
        maxKappa, kappaOfLog(fit, minimumOf(storageOfGrowth(fit), 0, std::log1p(maxKappa * fit.length), 1e-5)));
}

double kappaMinStorage(const LightFit& fit) {
    return fit.length > 0 ? kappaOfLog(fit, growthOfMinStorage(fit, 2000, 1e-12)) : 0.0;
}

std::optional<double> kappaAtEye(const LightFit& fit) {
    constexpr double kMaxRatio = 1e8;
    if (!(fit.zMin * kMaxRatio > fit.length)) return std::nullopt;
    return 1 / fit.zMin;
}

double kappaLog(const LightFit& fit, Search search) {
    if (!(fit.length > 0)) return 0;
    const double sought = search == Search::Fine ? growthOfMinStorage(fit, 32, 1e-5) : growthOfMinStorage(fit, 10, 0.1);
    // The smallest storage factor S is often at a kink, where two vertices have the same aliasing. The search only
    // approaches a kink. The code therefore also tests the warp about the eye directly.
    const std::optional<double> atEye = kappaAtEye(fit);
    if (atEye && storageFactor(fit, *atEye) <= storageOfGrowth(fit)(sought)) return *atEye;
    return kappaOfLog(fit, sought);
}

double kappaOfMap(const Warp& warp, const LightFit& fit, Face face) {
    if (face == Face::Near) return 0;
    if (rowsOf(warp.rule) == RowSpacing::Logarithmic && face != Face::Whole)
        if (const std::optional<double> atEye = kappaAtEye(fit)) return *atEye;
    return kappaOf(warp, fit);
}

double kappaOf(const Warp& warp, const LightFit& fit) {
    switch (warp.rule) {
    case WarpRule::None:
        return 0;
    case WarpRule::Psm:
        return 1 / fit.slice.near;
    case WarpRule::Lspsm:
        return kappaLspsm(fit);
    case WarpRule::Tsm: {
        const glm::dvec3 focus{0, 0, warp.tsmFocus ? fit.slice.near + *warp.tsmFocus : tsmFocusDepth(fit.slice)};
        return kappaTsm(fit, toLight(fit.frame, focus).z - fit.zMin, warp.tsmFraction);
    }
    case WarpRule::Minimax:
        return kappaMinimax(fit);
    case WarpRule::Auto:
        return kappaAuto(fit);
    case WarpRule::MinStorage:
        return kappaMinStorage(fit);
    case WarpRule::Eta:
        return 1 / nPrimeOfEta(fit.slice, warp.eta);
    case WarpRule::Given:
        return warp.kappa;
    case WarpRule::Log:
        return kappaLog(fit);
    }
    GNOMON_CHECK(false && "a warp rule without a kappa");
    return 0;
}

} // namespace gnomon::shadow
