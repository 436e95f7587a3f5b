#include "exact/cell_kernel.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "exact/cell_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::exact::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DoubleTag = hn::ScalableTag<double>;
using IntTag = hn::Rebind<std::int32_t, DoubleTag>;
using Doubles = hn::Vec<DoubleTag>;
using Mask = hn::Mask<DoubleTag>;

constexpr DoubleTag kDoubles;
constexpr IntTag kInts;

/// A projection matrix that is applied to one sample per SIMD lane.
struct PlaneLanes {
    const glm::dmat4x3& m;

    HWY_INLINE Doubles row(int k, Doubles u, Doubles v, Doubles h) const {
        auto linear = hn::Add(hn::Mul(hn::Set(kDoubles, m[0][k]), u), hn::Mul(hn::Set(kDoubles, m[1][k]), v));
        if (m[2][k] != 0) linear = hn::Add(linear, hn::Mul(hn::Set(kDoubles, m[2][k]), h));
        return hn::Add(linear, hn::Set(kDoubles, m[3][k]));
    }
};

/// Returns a mask of the SIMD lanes whose samples are in `run` and belong to `map`. Lane 0 is sample `i`.
HWY_INLINE Mask ofMap(const SampleRun& run, std::size_t i, std::size_t map) {
    const auto isListed = hn::FirstN(kDoubles, run.end - i);
    if (run.samples->space().maps == 1) return isListed;
    const auto maps = hn::PromoteTo(kDoubles, hn::LoadU(kInts, &run.samples->map[i]));
    return hn::And(isListed, hn::Eq(maps, hn::Set(kDoubles, static_cast<double>(map))));
}

/// The projected positions of samples on the plane of a map, with one sample per SIMD lane.
struct PlaceLanes {
    HWY_INLINE PlaceLanes(const PlaneLanes& plane, const SampleList& samples, std::size_t i) {
        const auto u = hn::LoadU(kDoubles, &samples.u[i]);
        const auto v = hn::LoadU(kDoubles, &samples.v[i]);
        const auto h = hn::LoadU(kDoubles, &samples.h[i]);
        w = plane.row(2, u, v, h);
        x = hn::Div(plane.row(0, u, v, h), w);
        y = hn::Div(plane.row(1, u, v, h), w);
    }

    Doubles x, y, w;
};

/// The min and max of values, per SIMD lane. NaN is ignored.
struct RangeLanes {
    HWY_INLINE RangeLanes()
        : min(hn::Set(kDoubles, std::numeric_limits<double>::infinity())),
          max(hn::Set(kDoubles, -std::numeric_limits<double>::infinity())) {}

    HWY_INLINE void add(Mask mask, Doubles value) {
        min = hn::IfThenElse(hn::And(mask, hn::Lt(value, min)), value, min);
        max = hn::IfThenElse(hn::And(mask, hn::Lt(max, value)), value, max);
    }

    Doubles min, max;
};

Extent extentInLanes(const glm::dmat4x3& plane, std::size_t map, const SampleRun& run) {
    RangeLanes x;
    RangeLanes y;
    RangeLanes w;
    Extent extent;
    for (std::size_t i = run.begin; i < run.end; i += hn::Lanes(kDoubles)) {
        const auto isOfMap = ofMap(run, i, map);
        if (hn::AllFalse(kDoubles, isOfMap)) continue;
        extent.samples += hn::CountTrue(kDoubles, isOfMap);
        const PlaceLanes place({plane}, *run.samples, i);
        x.add(isOfMap, place.x);
        y.add(isOfMap, place.y);
        w.add(isOfMap, place.w);
    }
    const auto min = [](const RangeLanes& range) HWY_ATTR { return hn::GetLane(hn::MinOfLanes(kDoubles, range.min)); };
    const auto max = [](const RangeLanes& range) HWY_ATTR { return hn::GetLane(hn::MaxOfLanes(kDoubles, range.max)); };
    extent.minW = min(w);
    extent.maxW = max(w);
    extent.min = {min(x), min(y)};
    extent.max = {max(x), max(y)};
    return extent;
}

/// Computes the cell column or row of coordinate `x` like cellAt, for one coordinate per SIMD lane.
HWY_INLINE hn::Vec<IntTag> cellLanes(Doubles x, int side) {
    const auto last = hn::Set(kDoubles, side - 1);
    const auto zero = hn::Zero(kDoubles);
    const auto held =
        hn::IfThenElse(hn::Ge(x, hn::Set(kDoubles, side)), last, hn::IfThenElse(hn::Gt(x, zero), x, zero));
    return hn::DemoteTo(kInts, held); // truncates
}

void findCellsInLanes(
    const glm::dmat4x3& matrix, std::size_t map, int side, const SampleRun& run, std::span<std::uint32_t> cells) {
    for (std::size_t i = run.begin; i < run.end; i += hn::Lanes(kDoubles)) {
        const auto isOfMap = ofMap(run, i, map);
        if (hn::AllFalse(kDoubles, isOfMap)) continue;
        const PlaceLanes place({matrix}, *run.samples, i);
        const auto row = hn::Mul(cellLanes(place.y, side), hn::Set(kInts, side));
        const auto cell = hn::Add(row, cellLanes(place.x, side));
        const hn::Rebind<std::uint32_t, DoubleTag> uints;
        if (hn::AllTrue(kDoubles, isOfMap)) {
            hn::StoreU(hn::BitCast(uints, cell), uints, &cells[i - run.begin]);
            continue;
        }
        std::array<std::uint32_t, 8> found{};
        std::array<std::uint8_t, 8> bits{};
        hn::StoreU(hn::BitCast(uints, cell), uints, found.data());
        hn::StoreMaskBits(kDoubles, isOfMap, bits.data());
        for (std::size_t lane = 0; lane < hn::Lanes(kDoubles); ++lane)
            if ((bits[0] >> lane & 1U) != 0) cells[i - run.begin + lane] = found[lane];
    }
}

} // namespace gnomon::exact::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::exact {

HWY_EXPORT(extentInLanes);
HWY_EXPORT(findCellsInLanes);

void Extent::add(const Extent& other) {
    samples += other.samples;
    minW = std::min(minW, other.minW);
    maxW = std::max(maxW, other.maxW);
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
}

Extent extentOn(const glm::dmat4x3& plane, std::size_t map, const SampleRun& run) {
    return HWY_DYNAMIC_DISPATCH(extentInLanes)(plane, map, run);
}

void findCells(
    const glm::dmat4x3& matrix, std::size_t map, int side, const SampleRun& run, std::span<std::uint32_t> cells) {
    HWY_DYNAMIC_DISPATCH(findCellsInLanes)(matrix, map, side, run, cells);
}

} // namespace gnomon::exact
#endif
