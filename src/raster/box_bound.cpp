#include "raster/box_bound.h"

#include "raster/uneven/row_bands.h"

#include <algorithm>
#include <array>
#include <cmath>

// The order matters: foreach_target.h includes this file again for each instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/box_bound.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Number of corners of a box. Each corner needs one SIMD lane.
constexpr std::size_t kCorners = 8;
using CornerTag = hn::CappedTag<float, kCorners>;
using Corners = hn::Vec<CornerTag>;
constexpr CornerTag kCornerTag;

/// Relative error of a sum of terms: 5 x 2^-24 by rounding in the vertex stage, and the same by rounding in this file.
constexpr float kSumError = 0x1p-20F;
/// Relative error of a quotient and of a pixel coordinate, by rounding in the vertex stage and in this file.
constexpr float kQuotientError = 0x1p-20F;
/// Absolute error by the underflow of products. It is far smaller than the smallest w (kMinW).
constexpr float kUnderflow = 0x1p-130F;

/// A clip-space coordinate at the eight corners of a box, with its max rounding error.
struct ClipRow {
    std::array<float, 3> low{}; // per axis: matrix entry times the coordinate at the lower end of the box
    std::array<float, 3> high{};
    float constant;
    float error;

    ClipRow(
        const Projection& projection, std::size_t row, const std::array<float, 3>& min, const std::array<float, 3>& max)
        : constant(projection.clipFromCell[12 + row]) {
        float magnitude = std::abs(constant);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float factor = projection.clipFromCell[4 * axis + row];
            low[axis] = factor * min[axis];
            high[axis] = factor * max[axis];
            magnitude += std::max(std::abs(low[axis]), std::abs(high[axis]));
        }
        error = magnitude * kSumError + kUnderflow;
    }

    HWY_INLINE Corners at(hn::Mask<CornerTag> x, hn::Mask<CornerTag> y, hn::Mask<CornerTag> z) const {
        const auto end = [this](hn::Mask<CornerTag> isUpper, std::size_t axis) HWY_ATTR {
            return hn::IfThenElse(isUpper, hn::Set(kCornerTag, high[axis]), hn::Set(kCornerTag, low[axis]));
        };
        return hn::Add(hn::Add(hn::Add(end(x, 0), end(y, 1)), end(z, 2)), hn::Set(kCornerTag, constant));
    }
};

/// The range of a clip-space coordinate divided by w, over the corners of a box. Rounding errors are not included.
struct QuotientRange {
    Corners lo, hi;

    HWY_INLINE QuotientRange()
        : lo(hn::Set(kCornerTag, hwy::HighestValue<float>())), hi(hn::Set(kCornerTag, hwy::LowestValue<float>())) {}

    HWY_INLINE void add(Corners quotient) {
        lo = hn::Min(lo, quotient);
        hi = hn::Max(hi, quotient);
    }

    HWY_INLINE void reduce(float& low, float& high) const {
        low = hn::GetLane(hn::MinOfLanes(kCornerTag, lo));
        high = hn::GetLane(hn::MaxOfLanes(kCornerTag, hi));
    }
};

/// The linear mapping from normalised device coordinates to pixels along one axis.
struct AxisScale {
    float scale;
    float translate;
};

struct PixelRange {
    int first;
    int end;
};

/// Returns the pixels along an axis whose centres are in [low, high]. The range is extended by `error` and by the
/// rounding of the mapping to pixels. All arguments are in normalised device coordinates.
PixelRange pixelsWithin(float low, float high, float error, const AxisScale& axis) {
    const auto [scale, translate] = axis;
    const float largest = std::max(std::abs(low), std::abs(high)) * scale + std::abs(translate) + 1;
    // The margin includes half a subpixel for snapping, and the rounding of the addition below.
    constexpr float kSnapping = 1.0F / kSubpixels;
    const float margin = error * scale + largest * kQuotientError + kSnapping;
    constexpr float kFar = 1 << 20; // pixels: larger than any viewport, and fits an int
    return {
        static_cast<int>(std::ceil(std::max(low * scale + translate - margin - 0.5F, -kFar))),
        static_cast<int>(std::floor(std::min(high * scale + translate + margin - 0.5F, kFar))) + 1};
}

/// Returns corner `end` of a box, relative to the eye.
std::array<float, 3> fromEye(const Projection& projection, const std::array<std::uint32_t, 3>& end) {
    std::array<float, 3> result{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        result[axis] = static_cast<float>(static_cast<std::int32_t>(end[axis] - projection.eyeCell[axis]));
    return result;
}

/// The corners of a box in clip space, with one corner per SIMD lane.
class BoxImage {
public:
    HWY_INLINE
    BoxImage(const Projection& projection, const std::array<float, 3>& min, const std::array<float, 3>& max)
        : projection_(&projection),
          x_(projection, 0, min, max),
          y_(projection, 1, min, max),
          z_(projection, 2, min, max),
          w_(projection, 3, min, max),
          isWhole_(hn::FirstN(kCornerTag, kCorners)),
          minW_(hn::Set(kCornerTag, hwy::HighestValue<float>())) {}

    HWY_INLINE void addCorners(std::size_t first) {
        const hn::RebindToSigned<CornerTag> ints;
        const auto corner = hn::Iota(ints, static_cast<std::int32_t>(first));
        const auto isUpper = [&](std::int32_t bit) HWY_ATTR {
            return hn::RebindMask(kCornerTag, hn::TestBit(corner, hn::Set(ints, bit)));
        };
        const auto x = x_.at(isUpper(1), isUpper(2), isUpper(4));
        const auto y = y_.at(isUpper(1), isUpper(2), isUpper(4));
        const auto z = z_.at(isUpper(1), isUpper(2), isUpper(4));
        const auto w = w_.at(isUpper(1), isUpper(2), isUpper(4));
        const auto certainW = hn::Sub(w, hn::Set(kCornerTag, w_.error));
        minW_ = hn::Min(minW_, certainW);
        const auto isWithin = [&](Corners value, float error, float guard) HWY_ATTR {
            return hn::Le(
                hn::Add(hn::Abs(value), hn::Set(kCornerTag, error)), hn::Mul(hn::Set(kCornerTag, guard), certainW));
        };
        isWhole_ = hn::And(isWhole_, hn::Gt(certainW, hn::Set(kCornerTag, 2 * kMinW)));
        isWhole_ = hn::And(isWhole_, isWithin(x, x_.error, projection_->guardX));
        isWhole_ = hn::And(isWhole_, isWithin(y, y_.error, projection_->guardY));
        if (projection_->cutsDepth)
            isWhole_ = hn::And(isWhole_, hn::And(isWithin(z, z_.error, 1), hn::Ge(z, hn::Set(kCornerTag, z_.error))));
        const auto inverseW = hn::Div(hn::Set(kCornerTag, 1.0F), w);
        rangeX_.add(hn::Mul(x, inverseW));
        rangeY_.add(hn::Mul(y, inverseW));
        rangeZ_.add(hn::Mul(z, inverseW));
    }

    HWY_INLINE BoxBound bound() const {
        BoxBound bound;
        bound.isWhole = hn::AllTrue(kCornerTag, isWhole_);
        if (!bound.isWhole) return bound;
        const float minW = hn::GetLane(hn::MinOfLanes(kCornerTag, minW_));
        float low = 0;
        float high = 0;
        rangeX_.reduce(low, high);
        const Projection& p = *projection_;
        const float offX = error(x_, low, high, minW);
        const PixelRange x = pixelsWithin(low, high, offX, {p.scaleX, p.translateX});
        rangeY_.reduce(low, high);
        const PixelRange y = rowsWithin(low, high, error(y_, low, high, minW));
        bound.box = {x.first, y.first, x.end, y.end};
        rangeZ_.reduce(low, high);
        const float off = error(z_, low, high, minW);
        bound.nearest = std::clamp(high + off, 0.0F, 1.0F);
        bound.min = std::clamp(low - off, 0.0F, 1.0F);
        return bound;
    }

private:
    PixelRange rowsWithin(float low, float high, float error) const {
        const Projection& p = *projection_;
        if (p.rows == nullptr) return pixelsWithin(low, high, error, {p.scaleY, p.translateY});
        const auto [first, end] = p.rows->rowsBetween(low - error, high + error);
        return {first, end};
    }

    /// Returns the max rounding error of a clip-space coordinate divided by w, if the quotient is in [low, high].
    float error(const ClipRow& row, float low, float high, float minW) const {
        const float largest = std::max(std::abs(low), std::abs(high));
        return ((row.error + largest * w_.error) / minW + largest * kQuotientError) * (1 + kQuotientError);
    }

    const Projection* projection_;
    ClipRow x_, y_, z_, w_;
    hn::Mask<CornerTag> isWhole_; // lanes whose corners need no clipping
    Corners minW_;
    QuotientRange rangeX_, rangeY_, rangeZ_;
};

BoxBound boxBoundInLanes(const Projection& projection, const CellBox& box) {
    BoxImage image(projection, fromEye(projection, box.min), fromEye(projection, box.max));
    for (std::size_t first = 0; first < kCorners; first += hn::Lanes(kCornerTag))
        image.addCorners(first);
    return image.bound();
}

} // namespace gnomon::raster::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::raster {

HWY_EXPORT(boxBoundInLanes);

BoxBound boxBound(const Projection& projection, const CellBox& box) {
    return HWY_DYNAMIC_DISPATCH(boxBoundInLanes)(projection, box);
}

} // namespace gnomon::raster
#endif
