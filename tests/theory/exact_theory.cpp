#include "tests/theory/exact_theory.h"

#include <limits>

namespace gnomon::theory::exact {

namespace {

const Real kInfinity = std::numeric_limits<double>::infinity();
const Vector kView{0, 0, 1};
const Vector kUp{0, 1, 0};

Real square(const Real& a) {
    return a * a;
}

Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

Vector operator*(const Vector& a, const Real& b) {
    return {a.x * b, a.y * b, a.z * b};
}

Real dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Real length(const Vector& a) {
    return root(dot(a, a));
}

Vector unit(const Vector& a) {
    return a * (1 / length(a));
}

Frame frameAlong(const Vector& light, const Vector& guide) {
    const Vector x = unit(cross(light, guide));
    return {x, light, cross(x, light)};
}

/// The corner on the side `x`, `y` (-1 or 1) at `depth`.
Vector corner(const Frustum& v, double x, double y, const Real& depth) {
    const Real tan = tangent(v.theta);
    return {v.aspect * tan * depth * x, tan * depth * y, depth};
}

/// The two corners of a side, as x and y of them.
std::array<std::array<double, 2>, 2> edgesOf(Side side) {
    switch (side) {
    case Side::Top:
        return {{{-1, 1}, {1, 1}}};
    case Side::Bottom:
        return {{{-1, -1}, {1, -1}}};
    case Side::Left:
        return {{{-1, -1}, {-1, 1}}};
    default:
        return {{{1, -1}, {1, 1}}};
    }
}

Fit fitOf(const Frustum& v, const Frame& frame, const std::vector<Vector>& corners) {
    Fit fit{v, frame, {}, kInfinity, 0};
    for (const Vector& p : corners) {
        fit.points.push_back({dot(frame.x, p), dot(frame.y, p), dot(frame.z, p), p.z, p.z == v.n});
        fit.zMin = lesser(fit.zMin, fit.points.back().zeta);
    }
    for (Point& point : fit.points) {
        point.zeta -= fit.zMin;
        fit.d = greater(fit.d, point.zeta);
    }
    return fit;
}

} // namespace

Real imageBeamWidth(const Frustum& v, const Real& depth, const Real& pixels) {
    return 2 * tangent(v.theta) * depth / pixels;
}

Real nPrimeLspsm(const Frustum& v) {
    return v.n + root(v.f * v.n);
}

Pair aliasingOverhead(const Frustum& v, const Real& nPrime, const Real& depth) {
    const Real kappa = 1 / nPrime;
    const Real w = 1 + kappa * (depth - v.n);
    const Real wFar = 1 + kappa * (v.f - v.n);
    return {v.f * w / (depth * wFar), (v.f - v.n) / (2 * tangent(v.theta)) * square(w) / (depth * wFar)};
}

Pair worstOverhead(const Frustum& v, const Real& nPrime) {
    const Pair near = aliasingOverhead(v, nPrime, v.n);
    const Pair far = aliasingOverhead(v, nPrime, v.f);
    return {greater(near.x, far.x), greater(near.z, far.z)};
}

Real storageOverhead(const Frustum& v, const Real& nPrime) {
    if (nPrime >= v.n) {
        const Pair worst = worstOverhead(v, nPrime);
        return worst.x * worst.z;
    }
    const Real both = v.n * (nPrime + v.f - v.n) / (nPrime * v.f);
    return (v.f / v.n - 1) / (2 * tangent(v.theta)) * square(both);
}

Real nPrimeOfEta(const Frustum& v, const Real& eta) {
    const Real alpha = v.f / v.n;
    if (eta <= 0) return v.n * (root(alpha) + 1 - eta * (alpha - 1)) / (eta + 1);
    return v.n * (root(alpha) + 1) / (eta * root(alpha) + 1);
}

Real etaOfNPrime(const Frustum& v, const Real& nPrime) {
    const Real min = worstOverhead(v, nPrimeLspsm(v)).z;
    const Real end = worstOverhead(v, nPrime > nPrimeLspsm(v) ? kInfinity : v.n).z;
    const Real eta = (worstOverhead(v, nPrime).z - min) / (end - min);
    return nPrime > nPrimeLspsm(v) ? -eta : eta;
}

Real nPrimeTsm(const Frustum& v, const Real& focus, const Real& fraction) {
    const Real d = v.f - v.n;
    const Real room = fraction * d - focus;
    return room > 0 ? (1 - fraction) * d * focus / room : kInfinity;
}

Real sliceRatio(const Real& n, const Real& f, int count) {
    return power(f / n, Real(1) / count);
}

Real split(const Real& n, const Real& f, int count, int index, const Real& lambda) {
    const Real fraction = Real(index) / count;
    return lambda * n * power(f / n, fraction) + (1 - lambda) * (n + (f - n) * fraction);
}

std::array<Real, 7> closedForms(const Frustum& v, int count) {
    const Real q = sliceRatio(v.n, v.f, count);
    const Real k = count;
    const Real twoTan = 2 * tangent(v.theta);
    return {
        k * q * (q - 1) / twoTan,
        k * (q - 1) / twoTan,
        k * q * (q - 1),
        k * q * q,
        2 * k * (q - 1),
        2 * k * (q - 1) + k,
        logarithm(v.f / v.n) / twoTan};
}

Real stableExtent(const Frustum& v) {
    const Real square = length(corner(v, 1, 1, v.f) - corner(v, -1, -1, v.f));
    return greater(square, length(corner(v, 1, 1, v.f) - corner(v, -1, -1, v.n)));
}

Real sinLightAngle(const Vector& light) {
    return length(cross(light, kView));
}

Frame plainFrame(const Vector& light) {
    return frameAlong(light, sinLightAngle(light) < 1e-12 ? kUp : kView);
}

Vector outward(const Frustum& v, Side side) {
    const Real tan = tangent(v.theta);
    switch (side) {
    case Side::Top:
        return unit({0, 1, -tan});
    case Side::Bottom:
        return unit({0, -1, -tan});
    case Side::Left:
        return unit({-1, 0, -v.aspect * tan});
    case Side::Right:
        return unit({1, 0, -v.aspect * tan});
    case Side::Near:
        break;
    }
    return {0, 0, -1};
}

bool bearsMap(const Frustum& v, const Vector& light, Side side) {
    const Real facing = dot(outward(v, side), light);
    return (light.z <= 0 ? facing : -facing) > 1e-12;
}

Real logStorage(const Frustum& v, const Vector& light) {
    Real sum = v.aspect * magnitude(light.z);
    for (const Side side : kSides) {
        if (!bearsMap(v, light, side)) continue;
        const auto [a, b] = edgesOf(side);
        const Vector left = corner(v, a[0], a[1], 1);
        const Vector right = corner(v, b[0], b[1], 1);
        // The integral of 1 / w_i^2 over the face as the light sees it.
        const Real area = magnitude(dot(cross(left, right), light));
        sum += logarithm(v.f / v.n) * area / square(2 * tangent(v.theta));
    }
    return sum;
}

Real logShearedStorage(const Frustum& v, const Vector& light) {
    const auto seen = [&](const Vector& p) { return length(cross(p, light)); };
    Real sum = v.aspect * seen({1, 0, 0}) * seen({0, 1, 0});
    for (const Side side : kSides) {
        if (!bearsMap(v, light, side)) continue;
        const auto [a, b] = edgesOf(side);
        const Vector left = corner(v, a[0], a[1], 1);
        const Vector right = corner(v, b[0], b[1], 1);
        sum +=
            logarithm(v.f / v.n) / square(2 * tangent(v.theta)) * seen(right - left) * greater(seen(left), seen(right));
    }
    return sum;
}

Fit fitSlice(const Frustum& v, const Vector& light) {
    std::vector<Vector> corners;
    for (const Real& depth : {v.n, v.f})
        for (const double x : {-1.0, 1.0})
            for (const double y : {-1.0, 1.0})
                corners.push_back(corner(v, x, y, depth));
    return fitOf(v, plainFrame(light), corners);
}

Fit fitFace(const Frustum& v, const Vector& light, Side side, bool isNormalized) {
    if (side == Side::Near)
        return fitOf(
            v,
            plainFrame(light),
            {corner(v, -1, -1, v.n), corner(v, 1, -1, v.n), corner(v, -1, 1, v.n), corner(v, 1, 1, v.n)});
    std::vector<Vector> corners;
    Vector guide{0, 0, 0};
    for (const auto& at : edgesOf(side)) {
        corners.push_back(corner(v, at[0], at[1], v.n));
        corners.push_back(corner(v, at[0], at[1], v.f));
        const Vector edge = corners.back() - corners[corners.size() - 2];
        const Vector flat = edge - light * dot(edge, light);
        guide = guide + (isNormalized ? unit(flat) : flat);
    }
    return fitOf(v, frameAlong(light, guide), corners);
}

Measures measures(const Fit& fit, const Real& kappa) {
    Real low = kInfinity;
    Real high = -kInfinity;
    for (const Point& point : fit.points) {
        const Real u = point.x / (1 + kappa * point.zeta);
        low = lesser(low, u);
        high = greater(high, u);
    }
    const Real shear = kappa * greater(magnitude(low), magnitude(high));
    const bool isBound = !fit.hasLogRows && shear > root(Real(2));
    Real row = fit.d / (1 + kappa * fit.d);
    if (fit.hasLogRows && kappa > 0) row = logarithm(1 + kappa * fit.d) / kappa;
    const Real pixel = 2 * tangent(fit.slice.theta);
    Measures result{high - low, 0, 0, 0};
    for (const Point& point : fit.points) {
        const Real w = 1 + kappa * point.zeta;
        const Real beam = row * (fit.hasLogRows ? w : w * w) / (pixel * point.depth);
        const Real tilt = isBound ? shear : kappa * point.x / w;
        result.mx = greater(result.mx, result.width * w / (pixel * point.depth));
        result.mz = greater(result.mz, beam);
        result.sheared = greater(result.sheared, beam * root(1 + square(tilt)));
    }
    return result;
}

Real kappaLspsm(const Fit& fit) {
    const Real sine = sinLightAngle(fit.frame.y);
    const Real n = fit.slice.n;
    return sine / (n + root(n * (n + fit.d * sine)));
}

Real kappaTsm(const Fit& fit, const Real& focusZeta, const Real& fraction) {
    const Real room = fraction * fit.d - focusZeta;
    if (room <= 0) return 0;
    Real max = 1e6 / fit.d;
    if (focusZeta <= 0) return max;
    return lesser(max, room / ((1 - fraction) * fit.d * focusZeta));
}

Real kappaMinimax(const Fit& fit) {
    Real near = 0;
    Real far = 0;
    for (const Point& point : fit.points) {
        Real& end = point.isNear ? near : far;
        end = greater(end, point.zeta);
    }
    return kappaMinimax(near, far, fit.d, fit.slice.f / fit.slice.n);
}

Real kappaMinimax(const Real& near, const Real& far, const Real& d, const Real& depthRatio) {
    if (d <= 2 * near) return 0;
    const Real r = root(depthRatio);
    const Real first = near > 0 ? (d - 2 * near) / (near * d) : kInfinity;
    const Real second = far > r * near ? (r - 1) / (far - r * near) : kInfinity;
    return lesser(lesser(first, second), 1e6 / d);
}

Real minStorage(const Fit& fit, const std::optional<Real>& max) {
    const auto storage = [&](const Real& growth) {
        const Measures found = measures(fit, (exponential(growth) - 1) / fit.d);
        return found.mx * found.mz;
    };
    Real low = 0;
    Real high = logarithm(1 + (max ? *max * fit.d : Real(1e6)));
    if (!max) {
        // A scan first: over all kappa S has more than one minimum.
        constexpr int kSteps = 2000;
        const Real step = high / kSteps;
        int best = 0;
        double min = std::numeric_limits<double>::infinity();
        for (int i = 0; i <= kSteps; ++i) {
            const double found = storage(step * i).rounded();
            if (found < min) best = i;
            min = found < min ? found : min;
        }
        low = greater(0, step * (best - 1));
        high = step * (best + 1);
    }
    const Real golden = (root(Real(5)) - 1) / 2;
    Real min = lesser(storage(low), storage(high));
    for (int i = 0; i < 180; ++i) {
        const Real width = golden * (high - low);
        const Real atHigh = storage(low + width);
        const Real atLow = storage(high - width);
        min = lesser(min, lesser(atLow, atHigh));
        (atLow <= atHigh ? high : low) = atLow <= atHigh ? low + width : high - width;
    }
    return min;
}

Map mapOf(const Fit& fit, const Real& kappa) {
    Real min = kInfinity;
    Real low = kInfinity;
    Real high = -kInfinity;
    for (const Point& point : fit.points) {
        const Real w = 1 + kappa * point.zeta;
        min = lesser(min, point.x / w);
        low = lesser(low, -point.y / w);
        high = greater(high, -point.y / w);
    }
    const Real width = measures(fit, kappa).width;
    return {fit.frame, kappa, fit.zMin, fit.d, min, width, low, high - low, fit.hasLogRows && kappa > 0};
}

std::array<Real, 6> pointOf(const Map& map, const Vector& p) {
    const Real zeta = dot(map.frame.z, p) - map.zMin;
    const Real w = 1 + map.kappa * zeta;
    const Real wFar = 1 + map.kappa * map.length;
    const Real u = dot(map.frame.x, p) / w;
    const Real depth = (-dot(map.frame.y, p) / w - map.rawMin) / map.rawRange;
    Real t = zeta * wFar / (map.length * w);
    Real beam = map.length / wFar * square(w);
    if (map.hasLogRows) {
        t = logarithm(w) / logarithm(wFar);
        beam = logarithm(wFar) / map.kappa * w;
    }
    return {(u - map.uMin) / map.width, t, depth, map.width * w, beam, beam * root(1 + square(map.kappa * u))};
}

Real largestRawBias(const Fit& fit, const Real& kappa, const Real& texels, const Real& filterTexels) {
    const Real reach = greater(1, filterTexels) / 2 + 1 / Real(256);
    Real shear = 0;
    Real raw = 0;
    for (const Point& point : fit.points) {
        const Real w = 1 + kappa * point.zeta;
        shear = greater(shear, kappa * magnitude(point.x) / w);
        raw = greater(raw, magnitude(point.y) / w);
    }
    const Real stepS = measures(fit, kappa).width / texels;
    Real stepT = fit.d / texels;
    if (fit.hasLogRows && kappa > 0) {
        // From the last row on, over the reach.
        const Real growth = logarithm(1 + kappa * fit.d) / texels;
        stepT = (exponential(reach * growth) - 1) / (kappa * reach);
    }
    return reach *
           (10 * (stepS + (1 + shear) * stepT) + kappa * raw * stepT + Real(3.4) * root(square(stepS) + square(stepT)));
}

} // namespace gnomon::theory::exact
