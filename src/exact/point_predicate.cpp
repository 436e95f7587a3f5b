#include "exact/point_predicate.h"

namespace gnomon::exact {

namespace {

__extension__ using Long = __int128;

struct LongVector {
    Long x = 0;
    Long y = 0;
    Long z = 0;
};

LongVector across(const glm::i64vec3& a, const glm::i64vec3& b) {
    return {Long{a.y} * b.z - Long{a.z} * b.y, Long{a.z} * b.x - Long{a.x} * b.z, Long{a.x} * b.y - Long{a.y} * b.x};
}

Long product(const LongVector& a, const glm::i64vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

int signOfLong(Long value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// Returns the sign of the dot product a . b, computed exactly with 192 bits. Components of `b` must be below 2^61.
int signOfProduct(const LongVector& a, const glm::i64vec3& b) {
    constexpr int kLimb = 64;
    Long high = 0; // multiples of 2^64
    Long low = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const Long value = axis == 0 ? a.x : axis == 1 ? a.y : a.z;
        high += (value >> kLimb) * b[axis]; // rounds down
        low += Long{static_cast<std::uint64_t>(value)} * b[axis];
    }
    high += low >> kLimb;
    if (high != 0) return signOfLong(high);
    return static_cast<std::uint64_t>(low) != 0 ? 1 : 0;
}

LongVector normalAcross(const Corners& corners) {
    return across(corners[1] - corners[0], corners[2] - corners[0]);
}

constexpr std::int64_t kWhole = std::int64_t{1} << kWeightBits;

/// Tells on which side of a triangle edge the ray to the light passes: 1 or -1, or 0 if the edge points to the light.
struct PassedSide {
    int sign = 0;
    bool isOnEdge = false;
};

PassedSide passedSide(
    const glm::i64vec3& a, const glm::i64vec3& b, const glm::i64vec3& light, const glm::i64vec3& point) {
    const LongVector e = across(b - a, light - a);
    const int sign = signOfProduct(e, a * kWhole - point);
    if (sign != 0) return {sign, false};
    const Long first = e.x != 0 ? e.x : e.y != 0 ? e.y : e.z;
    return {-signOfLong(first), true};
}

} // namespace

int facingPoint(const Corners& corners, const glm::i64vec3& light) {
    return signOfLong(product(normalAcross(corners), light - corners[0]));
}

std::optional<PointRay> rayToPoint(const glm::i64vec3& light, const glm::i64vec3& scaledPoint) {
    glm::dvec3 towards;
    for (int axis = 0; axis < 3; ++axis)
        towards[axis] = static_cast<double>(Long{light[axis]} * kWhole - scaledPoint[axis]);
    if (towards == glm::dvec3(0)) return std::nullopt;
    const IntegerLight direction = roundedLight(towards);
    return PointRay{direction, twoSteps(direction)};
}

RayHit intersectTowards(
    const Corners& caster, const glm::i64vec3& light, const glm::i64vec3& scaledPoint, const PointRay& ray) {
    const LongVector normal = normalAcross(caster);
    const int side = signOfLong(product(normal, light - caster[0]));
    if (side == 0) return {};
    bool isOnEdge = false;
    for (std::size_t k = 0; k < caster.size(); ++k) {
        const PassedSide passed = passedSide(caster[k], caster[(k + 1) % caster.size()], light, scaledPoint);
        if (passed.sign != side) return {};
        isOnEdge = isOnEdge || passed.isOnEdge;
    }
    const Long ahead = side * product(normal, caster[0] * kWhole - scaledPoint);
    if (ahead <= 0) return {};
    const Long along = product(normal, ray.direction.direction);
    const Long size = along < 0 ? -along : along;
    return {ahead > size * ray.tolerance ? Hit::Ahead : Hit::WithinTolerance, isOnEdge};
}

RayHit intersectTowards(const Corners& caster, const glm::i64vec3& light, const glm::i64vec3& scaledPoint) {
    const std::optional<PointRay> ray = rayToPoint(light, scaledPoint);
    return ray ? intersectTowards(caster, light, scaledPoint, *ray) : RayHit{};
}

} // namespace gnomon::exact
