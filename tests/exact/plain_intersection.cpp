#include "tests/exact/plain_intersection.h"

#include "exact/point_predicate.h"
#include "tests/exact/wide_integer.h"

namespace gnomon::exact {

namespace {

using WideVector = std::array<WideInteger, 3>;

WideVector wide(const glm::i64vec3& v) {
    return {v.x, v.y, v.z};
}

WideVector operator-(const WideVector& a, const WideVector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

WideVector operator*(const WideVector& a, const WideInteger& factor) {
    return {a[0] * factor, a[1] * factor, a[2] * factor};
}

WideInteger determinant(const WideVector& a, const WideVector& b, const WideVector& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// A polynomial of e: its coefficients from e^0 to e^3.
using Polynomial = std::array<WideInteger, 4>;

/// The sign for every small enough e > 0.
int signOf(const Polynomial& p) {
    for (const WideInteger& coefficient : p)
        if (coefficient.sign() != 0) return coefficient.sign();
    return 0;
}

/// det(d + (e, e^2, e^3), b, c), or with the moving vector in the second place.
Polynomial movedDeterminant(const WideVector& moving, const WideVector& other, const WideVector& light, bool isFirst) {
    const auto with = [&](const WideVector& v) {
        return isFirst ? determinant(v, other, light) : determinant(other, v, light);
    };
    return {with(moving), with({1, 0, 0}), with({0, 1, 0}), with({0, 0, 1})};
}

} // namespace

RayHit plainHit(
    const Corners& caster, const IntegerLight& light, const glm::i64vec3& scaledPoint, std::uint32_t tolerance) {
    const WideInteger scale = std::int64_t{1} << kWeightBits;
    const WideVector a = wide(caster[0]);
    const WideVector b = wide(caster[1]) - a;
    const WideVector c = wide(caster[2]) - a;
    const WideVector l = wide(light.direction);
    const WideVector fromA = wide(scaledPoint) - a * scale;
    // fromA + t L = y (scale b) + z (scale c): y det(b, c, L) scale = det(fromA, c, L), and so on.
    const WideInteger whole = determinant(b, c, l);
    if (whole.sign() == 0) return {};
    Polynomial y = movedDeterminant(fromA, c, l, true);
    Polynomial z = movedDeterminant(fromA, b, l, false);
    Polynomial x;
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = (i == 0 ? whole * scale : WideInteger(0)) - y[i] - z[i];
        if (whole.sign() > 0) continue;
        x[i] = -x[i];
        y[i] = -y[i];
        z[i] = -z[i];
    }
    if (signOf(x) < 0 || signOf(y) < 0 || signOf(z) < 0) return {};
    WideInteger ahead = -determinant(fromA, b, c); // t det(b, c, L)
    WideInteger size = whole;
    if (whole.sign() < 0) {
        ahead = -ahead;
        size = -size;
    }
    if (ahead.sign() <= 0) return {};
    const bool isOnEdge = x[0].sign() == 0 || y[0].sign() == 0 || z[0].sign() == 0;
    const bool isFar = (ahead - size * WideInteger(tolerance)).sign() > 0;
    return {isFar ? Hit::Ahead : Hit::WithinTolerance, isOnEdge};
}

RayHit plainPointHit(const Corners& caster, const glm::i64vec3& light, const glm::i64vec3& scaledPoint) {
    const WideInteger scale = std::int64_t{1} << kWeightBits;
    const WideVector a = wide(caster[0]);
    const WideVector b = wide(caster[1]) - a;
    const WideVector c = wide(caster[2]) - a;
    const WideVector l = (wide(light) - a) * scale;
    const WideVector f = wide(scaledPoint) - a * scale;
    // f + t (l - f) = y b + z c: y whole = det(f, c, l), z whole = det(b, f, l), t whole = -det(b, c, f); of f alone
    // the others come near or far as it moves.
    Polynomial whole = movedDeterminant(f, b, c, true);
    for (std::size_t i = 0; i < whole.size(); ++i)
        whole[i] = (i == 0 ? determinant(b, c, l) : WideInteger(0)) - whole[i];
    const Polynomial y = movedDeterminant(f, c, l, true);
    const Polynomial z = movedDeterminant(f, b, l, false);
    Polynomial x;
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = whole[i] * scale - y[i] - z[i];
    const int side = determinant(b, c, l).sign();
    const WideInteger ahead = side < 0 ? determinant(b, c, f) : -determinant(b, c, f);
    if (side == 0 || ahead.sign() <= 0) return {};
    if (signOf(whole) != side || signOf(x) != side || signOf(y) != side || signOf(z) != side) return {};
    const bool isOnEdge = x[0].sign() == 0 || y[0].sign() == 0 || z[0].sign() == 0;
    const PointRay ray = *rayToPoint(light, scaledPoint);
    const WideInteger along = determinant(b, c, wide(ray.direction.direction));
    const WideInteger reach = (along.sign() < 0 ? -along : along) * WideInteger(ray.tolerance);
    return {(ahead - reach).sign() > 0 ? Hit::Ahead : Hit::WithinTolerance, isOnEdge};
}

} // namespace gnomon::exact
