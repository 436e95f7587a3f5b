#include "preprocess/simplify/cost_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preprocess/simplify/cost_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::simplify::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, kMaxCostLanes>;
using Doubles = hn::Vec<Tag>;
using Ends = std::array<const CostSite*, kMaxCostLanes>;
using Row = CostSite::Row;

constexpr Tag kDoubles;

struct Vector {
    Doubles x;
    Doubles y;
    Doubles z;
};

/// Returns the x, y and z coordinates of one attribute of the edge ends. Each SIMD lane contains one edge end.
HWY_INLINE Vector turned(const Ends& ends, Row CostSite::*row) {
#if HWY_TARGET <= HWY_AVX2 // four SIMD lanes; loads of single numbers would stall
    const auto a = hn::Load(kDoubles, (ends[0]->*row).data());
    const auto b = hn::Load(kDoubles, (ends[1]->*row).data());
    const auto c = hn::Load(kDoubles, (ends[2]->*row).data());
    const auto d = hn::Load(kDoubles, (ends[3]->*row).data());
    const auto abLower = hn::InterleaveLower(kDoubles, a, b);
    const auto cdLower = hn::InterleaveLower(kDoubles, c, d);
    const auto abUpper = hn::InterleaveUpper(kDoubles, a, b);
    const auto cdUpper = hn::InterleaveUpper(kDoubles, c, d);
    return {
        hn::ConcatLowerLower(kDoubles, cdLower, abLower),
        hn::ConcatLowerLower(kDoubles, cdUpper, abUpper),
        hn::ConcatUpperUpper(kDoubles, cdLower, abLower)};
#else
    std::array<Row, 3> lanes{};
    for (std::size_t axis = 0; axis < lanes.size(); ++axis)
        for (std::size_t k = 0; k < hn::Lanes(kDoubles); ++k)
            lanes[axis][k] = (ends[k]->*row)[axis];
    return {
        hn::LoadU(kDoubles, lanes[0].data()),
        hn::LoadU(kDoubles, lanes[1].data()),
        hn::LoadU(kDoubles, lanes[2].data())};
#endif
}

HWY_INLINE Vector all(const glm::dvec3& v) {
    return {hn::Set(kDoubles, v.x), hn::Set(kDoubles, v.y), hn::Set(kDoubles, v.z)};
}

HWY_INLINE Doubles dot(const Vector& a, const Vector& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Doubles squaredLength(const Vector& v) {
    return dot(v, v);
}

HWY_INLINE Doubles squaredChange(const Row& from, const Vector& to) {
    const Vector v = all(vectorOf(from));
    return squaredLength({hn::Sub(v.x, to.x), hn::Sub(v.y, to.y), hn::Sub(v.z, to.z)});
}

HWY_INLINE Doubles twice(Doubles v) {
    return hn::Add(v, v);
}

/// Returns Quadric::meanSquare of the quadric `planes` for the point in each SIMD lane.
HWY_INLINE Doubles meanSquares(const Quadric& planes, const Vector& p) {
    const Vector mixed = all(planes.mixed);
    const Doubles across = hn::Add(
        hn::Add(hn::Mul(hn::Mul(mixed.x, p.x), p.y), hn::Mul(hn::Mul(mixed.y, p.y), p.z)),
        hn::Mul(hn::Mul(mixed.z, p.z), p.x));
    const Vector squares{hn::Mul(p.x, p.x), hn::Mul(p.y, p.y), hn::Mul(p.z, p.z)};
    const Doubles square = hn::Add(dot(all(planes.diagonal), squares), twice(across));
    const Doubles sum = hn::Add(hn::Add(square, twice(dot(all(planes.linear), p))), hn::Set(kDoubles, planes.constant));
    const Doubles nonNegative = hn::IfThenElseZero(hn::Gt(sum, hn::Zero(kDoubles)), sum);
    return hn::Div(nonNegative, hn::Set(kDoubles, planes.weight));
}

void squaresInLanes(const EdgeFan& fan, const EdgeWeights& weights, double* squares) {
    const bool hasNormal = weights.normal > 0 && fan.from.hasNormal();
    for (std::size_t i = 0; i < fan.to.size(); i += hn::Lanes(kDoubles)) {
        Ends ends{};
        for (std::size_t k = 0; k < ends.size(); ++k) // the last edge end fills the unused SIMD lanes
            ends[k] = &fan.sites[fan.to[std::min(i + k, fan.to.size() - 1)]];
        const Vector position = turned(ends, &CostSite::position);
        const Doubles length = squaredChange(fan.from.position, position);
        Doubles attributes = hn::Zero(kDoubles);
        if (hasNormal) {
            const Vector normal = turned(ends, &CostSite::normal);
            attributes = hn::IfThenElseZero(
                hn::Gt(squaredLength(normal), hn::Zero(kDoubles)),
                hn::Mul(hn::Set(kDoubles, weights.normal), squaredChange(fan.from.normal, normal)));
        }
        if (weights.color > 0) {
            const Doubles change = squaredChange(fan.from.color, turned(ends, &CostSite::color));
            attributes = hn::Add(attributes, hn::Mul(hn::Set(kDoubles, weights.color), change));
        }
        const Doubles share = hn::Add(hn::Set(kDoubles, weights.length), attributes);
        hn::StoreU(hn::Add(meanSquares(fan.planes, position), hn::Mul(length, share)), kDoubles, squares + i);
    }
}

} // namespace gnomon::simplify::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::simplify {

HWY_EXPORT(squaresInLanes);

void edgeSquares(const EdgeFan& fan, const EdgeWeights& weights, double* squares) {
    HWY_DYNAMIC_DISPATCH(squaresInLanes)(fan, weights, squares);
}

} // namespace gnomon::simplify
#endif
