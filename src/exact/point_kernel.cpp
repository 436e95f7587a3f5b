#include "exact/sample_list.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "exact/point_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::exact::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DoubleTag = hn::ScalableTag<double>;
using Doubles = hn::Vec<DoubleTag>;
using IntTag = hn::Rebind<std::int32_t, DoubleTag>;
using FloatTag = hn::Rebind<float, DoubleTag>;
using LongTag = hn::RebindToSigned<DoubleTag>;

constexpr DoubleTag kDoubles;
constexpr IntTag kInts;
constexpr FloatTag kFloats;
constexpr LongTag kLongs;

struct Vec3 {
    Doubles x, y, z;

    HWY_INLINE Doubles operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

HWY_INLINE Doubles constant(double value) {
    return hn::Set(kDoubles, value);
}

HWY_INLINE Vec3 load(const std::array<const std::int32_t*, 3>& from, std::size_t i) {
    const auto axis = [&](std::size_t k) HWY_ATTR { return hn::PromoteTo(kDoubles, hn::LoadU(kInts, from[k] + i)); };
    return {axis(0), axis(1), axis(2)};
}

HWY_INLINE Doubles dot(const Vec3& a, const Vec3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Vec3 cross(const Vec3& a, const Vec3& b) {
    return {
        hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
        hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
        hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

HWY_INLINE Vec3 subtract(const Vec3& a, const Vec3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vec3 constant(const glm::dvec3& v) {
    return {constant(v.x), constant(v.y), constant(v.z)};
}

HWY_INLINE Doubles size(const Vec3& v) {
    return hn::Max(hn::Max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

/// The barycentric weights of corners 1 and 2 as integers in units of 2^-24, with one point per SIMD lane. Each weight
/// is at least 1, and their sum is below 2^24.
struct WeightLanes {
    Doubles second, third;
};

HWY_INLINE WeightLanes weightLanes(const PointBatch& batch, std::size_t i) {
    const auto one = constant(0x1p24);
    const auto scaled = [&](const float* from) HWY_ATTR {
        return hn::Round(hn::Mul(hn::PromoteTo(kDoubles, hn::LoadU(kFloats, from + i)), one));
    };
    const auto minWeight = constant(1);
    const auto second = hn::Min(hn::Max(scaled(batch.second), minWeight), constant(0x1p24 - 2));
    const auto third = hn::Min(hn::Max(scaled(batch.third), minWeight), hn::Sub(constant(0x1p24 - 1), second));
    return {second, third};
}

/// Tests whether light and eye are on the same side of the triangle. The result is 1 if they are, 0 if not, and 2 if
/// rounding may change the answer. A side is the sign of a sum. Its terms are at most 6 times the product of the sizes,
/// with at most ten roundings each.
HWY_INLINE hn::Vec<LongTag> facesLight(const SampleSpace& space, const Vec3& corner, const Vec3& e1, const Vec3& e2) {
    const Vec3 normal = cross(e1, e2);
    const Vec3 light = space.pointLight ? subtract(constant(glm::dvec3(*space.pointLight)), corner)
                                        : constant(glm::dvec3(space.light.direction));
    const Vec3 towardsEye = subtract(constant(space.eye), corner);
    const auto lightSide = dot(normal, light);
    const auto eyeSide = dot(normal, towardsEye);
    const auto edges = hn::Mul(hn::Mul(size(e1), size(e2)), constant(0x1p-46));
    const auto isSure = hn::And(
        hn::Gt(hn::Abs(lightSide), hn::Mul(edges, space.pointLight ? size(light) : constant(0x1p24))),
        hn::Gt(hn::Abs(eyeSide), hn::Mul(edges, size(towardsEye))));
    const auto zero = hn::Zero(kDoubles);
    const auto isSame =
        hn::Xor(hn::VecFromMask(kDoubles, hn::Lt(lightSide, zero)), hn::VecFromMask(kDoubles, hn::Gt(eyeSide, zero)));
    const auto faces = hn::IfThenElse(hn::MaskFromVec(isSame), constant(1), zero);
    return hn::ConvertTo(kLongs, hn::IfThenElse(isSure, faces, constant(2)));
}

HWY_INLINE void shearLanes(const SampleSpace& space, const PointBatch& batch, std::size_t i, ShearedPoints& points) {
    const Vec3 corner = load(batch.corner, i);
    const Vec3 e1 = load(batch.edge1, i);
    const Vec3 e2 = load(batch.edge2, i);
    const WeightLanes weights = weightLanes(batch, i);
    const auto coordinate = [&](int axis) HWY_ATTR {
        const auto along = hn::Add(hn::Mul(e1[axis], weights.second), hn::Mul(e2[axis], weights.third));
        return hn::Add(corner[axis], hn::Mul(along, constant(0x1p-24)));
    };
    const LightShear& shear = space.shear;
    const auto along = coordinate(shear.along);
    const auto sheared = [&](int axis, double ratio)
                             HWY_ATTR { return hn::Sub(coordinate(axis), hn::Mul(along, constant(ratio))); };
    hn::StoreU(sheared(shear.first, shear.firstRatio), kDoubles, points.u.data() + i);
    hn::StoreU(sheared(shear.second, shear.secondRatio), kDoubles, points.v.data() + i);
    hn::StoreU(hn::Mul(along, constant(shear.sign)), kDoubles, points.h.data() + i);
    const hn::Rebind<std::uint32_t, DoubleTag> uints;
    const auto whole = [&](Doubles weight) HWY_ATTR { return hn::BitCast(uints, hn::DemoteTo(kInts, weight)); };
    hn::StoreU(whole(weights.second), uints, points.second.data() + i);
    hn::StoreU(whole(weights.third), uints, points.third.data() + i);
    const hn::Rebind<std::uint8_t, DoubleTag> bytes;
    const auto faces = hn::BitCast(hn::RebindToUnsigned<LongTag>(), facesLight(space, corner, e1, e2));
    hn::StoreU(hn::TruncateTo(bytes, faces), bytes, points.faces.data() + i);
}

void shearPointsInLanes(const SampleSpace& space, const PointBatch& batch, ShearedPoints& points) {
    for (std::size_t i = 0; i < batch.count; i += hn::Lanes(kDoubles))
        shearLanes(space, batch, i, points);
}

} // namespace gnomon::exact::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::exact {

HWY_EXPORT(shearPointsInLanes);

void shearPoints(const SampleSpace& space, const PointBatch& batch, ShearedPoints& points) {
    HWY_DYNAMIC_DISPATCH(shearPointsInLanes)(space, batch, points);
}

} // namespace gnomon::exact
#endif
