#include "exact/lookup_mask.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace gnomon::exact {

namespace {

/// Max relative error of a sum of four terms in the rasteriser's float arithmetic. Five roundings cause the error
/// (Higham 2002, section 3.1), and three more are a safety margin.
constexpr double kSumError = 0x1p-21;
/// Max relative error of a quotient in the rasteriser's float arithmetic.
constexpr double kQuotientError = 0x1p-21;
/// Margin of the bounds in texels: the max displacement of a vertex by snapping and rounding, plus the distance from an
/// edge to a pixel centre.
constexpr double kTexelMargin = 1;

/// A clip-space coordinate as a linear function over a box: the value at the middle, the change from the middle to each
/// side, and the max rounding error of the rasteriser in the box.
struct ClipRow {
    std::array<double, 3> half{};
    double middle = 0;
    double error = 0;

    ClipRow(const raster::View& view, int row, const std::array<double, 3>& min, const std::array<double, 3>& max) {
        middle = view.clipFromCell[3][row];
        double magnitude = std::abs(middle);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double factor = view.clipFromCell[static_cast<int>(axis)][row];
            middle += factor * (min[axis] + max[axis]) / 2;
            half[axis] = factor * (max[axis] - min[axis]) / 2;
            magnitude += std::abs(factor) * std::max(std::abs(min[axis]), std::abs(max[axis]));
        }
        error = magnitude * kSumError;
    }

    double at(unsigned corner) const {
        double value = middle;
        for (std::size_t axis = 0; axis < 3; ++axis)
            value += (corner >> axis & 1U) != 0 ? half[axis] : -half[axis];
        return value;
    }
};

/// The range of a clip-space coordinate divided by w, over the corners of a box. The range is valid for the whole box,
/// because w is positive there.
struct QuotientRange {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();

    void add(double value, double error, double minW, double maxW) {
        const double low = value - error;
        const double high = value + error;
        min = std::min(min, low / (low < 0 ? minW : maxW));
        max = std::max(max, high / (high < 0 ? maxW : minW));
    }
};

int clampedTexel(double coordinate, int low, int high) {
    return static_cast<int>(std::clamp(coordinate, static_cast<double>(low), static_cast<double>(high)));
}

/// Computes the texels of [first, end) whose centres may be in `range`, which is in normalised device coordinates.
void setTexels(const QuotientRange& range, int first, int end, int& low, int& high) {
    const double scale = 0.5 * (end - first);
    const auto margin = [](double quotient) { return std::abs(quotient) * kQuotientError; };
    const double min = first + (1 + range.min - margin(range.min)) * scale - kTexelMargin;
    const double max = first + (1 + range.max + margin(range.max)) * scale + kTexelMargin;
    low = clampedTexel(std::floor(min), first, end);
    high = clampedTexel(std::floor(max) + 1, first, end);
}

/// Computes the rows of a logarithmic shadow map whose y / w may be in `range`. The snapping of vertices moves an edge
/// by less than the distance to the next row.
void setUnevenRows(const QuotientRange& range, const raster::View& view, int& low, int& high) {
    const std::span<const float> rows = view.rowPositions;
    const auto margin = [](double quotient) { return std::abs(quotient) * kQuotientError; };
    const auto first = std::lower_bound(rows.begin(), rows.end(), range.min - margin(range.min));
    const auto end = std::upper_bound(first, rows.end(), range.max + margin(range.max));
    low = std::max(view.viewport.y0 + static_cast<int>(first - rows.begin()) - 1, view.viewport.y0);
    high = std::min(view.viewport.y0 + static_cast<int>(end - rows.begin()) + 1, view.viewport.y1);
}

} // namespace

CasterBound casterBound(const raster::View& view, const raster::CellBox& box) {
    std::array<double, 3> min{};
    std::array<double, 3> max{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        min[axis] = static_cast<double>(box.min[axis]) - view.eyeCell[static_cast<int>(axis)];
        max[axis] = static_cast<double>(box.max[axis]) - view.eyeCell[static_cast<int>(axis)];
    }
    const ClipRow x(view, 0, min, max);
    const ClipRow y(view, 1, min, max);
    const ClipRow z(view, 2, min, max);
    const ClipRow w(view, 3, min, max);
    QuotientRange rangeX;
    QuotientRange rangeY;
    QuotientRange rangeZ;
    constexpr double kMinW = 1e-20;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const double minW = w.at(corner) - w.error;
        const double maxW = w.at(corner) + w.error;
        if (!(minW > kMinW)) return {view.viewport, 0};
        rangeX.add(x.at(corner), x.error, minW, maxW);
        rangeY.add(y.at(corner), y.error, minW, maxW);
        rangeZ.add(z.at(corner), z.error, minW, maxW);
    }
    CasterBound bound;
    setTexels(rangeX, view.viewport.x0, view.viewport.x1, bound.texels.x0, bound.texels.x1);
    if (view.rowPositions.empty())
        setTexels(rangeY, view.viewport.y0, view.viewport.y1, bound.texels.y0, bound.texels.y1);
    else
        setUnevenRows(rangeY, view, bound.texels.y0, bound.texels.y1);
    const double nearest = std::clamp(rangeZ.min - std::abs(rangeZ.min) * kQuotientError, 0.0, 1.0);
    bound.nearest = std::nextafter(static_cast<float>(nearest), -1.0F);
    return bound;
}

void LookupMask::reset(int width, int height) {
    mask_.reset(width, height);
}

void LookupMask::lower(const LookupTexels& blocks, float to) {
    for (int y = blocks.firstRow; y <= blocks.lastRow; ++y)
        for (int x = blocks.firstColumn; x <= blocks.lastColumn; ++x) {
            const std::atomic_ref<float> shared(mask_.lowest(x, y));
            float now = shared.load(std::memory_order_relaxed);
            while (to < now && !shared.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
            }
        }
}

bool LookupMask::isEmpty(const raster::PixelBox& box) const {
    constexpr float kHighest = std::numeric_limits<float>::max();
    return box.empty() || !mask_.mayShadow({box.x0, box.y0, box.x1 - 1, box.y1 - 1}, kHighest);
}

bool LookupMask::mayShadow(const CasterBound& bound) const {
    const raster::PixelBox& box = bound.texels;
    return !box.empty() && mask_.mayShadow({box.x0, box.y0, box.x1 - 1, box.y1 - 1}, -bound.nearest);
}

} // namespace gnomon::exact
