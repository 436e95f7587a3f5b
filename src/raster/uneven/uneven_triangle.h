// A triangle of any size on rows that lie unevenly: which samples of a row are inside, in 64-bit integers, and the
// plane of its depth.
#pragma once

#include "raster/uneven/row_bands.h"
#include "raster/wide_triangle.h"

#include <algorithm>
#include <cmath>

namespace gnomon::raster {

/// A vertex snapped for one band.
struct UnevenVertex {
    std::int32_t x = 0; // 1/256 pixel
    std::int64_t y = 0; // units of the band
    double restX = 0;   // unsnapped less snapped
    double unsnappedY = 0;
    float z = 0;
};

/// `vertex`, whose y holds the bits of y / w, in `band`.
UnevenVertex unevenVertex(const RowBand& band, const SnappedVertex& vertex);

/// The largest power of two up to which a quotient of samples is told apart; all of a target lies below.
constexpr double kFarSamples = 0x1p30;

/// A triangle turned counter-clockwise, with y up. Corners may be in either order.
class UnevenTriangle {
public:
    explicit UnevenTriangle(std::array<UnevenVertex, 3> corners);

    bool hasArea() const { return hasArea_; }

    /// Whether a sample of `box` may be inside; `box` is of rows of `band`.
    bool mayTouch(const RowBand& band, const PixelBox& box) const;

    /// The samples of row `y` of the target, which is of `band`, in columns from x0 to x1 - 1; depth as WideRow has it.
    WideRow row(const RowBand& band, int y, int x0, int x1) const;

    int referenceX() const { return corners_[0].x >> kSubpixelBits; }

    float depthPerX() const { return static_cast<float>(depthPerX_); }

    float leastDepth() const { return leastDepth_; }

    float largestDepth() const { return largestDepth_; }

private:
    /// Inside where dx Y - dy X + atOrigin >= 0.
    struct Edge {
        std::int64_t dx = 0;
        std::int64_t dy = 0;
        std::int64_t atOrigin = 0;
        std::int64_t perPixel = 0; // -256 dy, what it grows by from a column to the next
        double inverse = 0;        // of its magnitude
    };

    void setPlane(bool isTrue);

    std::array<UnevenVertex, 3> corners_;
    std::array<Edge, 3> edges_;
    bool hasArea_ = false;
    double depthPerX_ = 0; // per pixel
    double depthPerY_ = 0; // per unit
    double startX_ = 0;    // of corner 0, in 1/256 pixel and units, as the plane takes it
    double startY_ = 0;
    float leastDepth_ = 0; // of the corners, within 0 to 1
    float largestDepth_ = 0;
};

/// The floor of a / b, b above 0 with that `inverse`; at least kFarSamples from 0 where the quotient is. An estimate
/// that is off by one at most, and its correction.
inline std::int64_t flooredSamples(std::int64_t a, std::int64_t b, double inverse) {
    const double quotient = static_cast<double>(a) * inverse;
    if (std::abs(quotient) >= kFarSamples) return static_cast<std::int64_t>(std::copysign(kFarSamples, quotient));
    const auto estimate = static_cast<std::int64_t>(quotient);
    const std::int64_t rest = a - estimate * b;
    return estimate - (rest < 0 ? 1 : 0) + (rest >= b ? 1 : 0);
}

inline WideRow UnevenTriangle::row(const RowBand& band, int y, int x0, int x1) const {
    const std::int64_t units = band.rows[static_cast<std::size_t>(y - band.first)];
    std::int64_t first = x0;
    std::int64_t end = x1;
    for (const Edge& edge : edges_) {
        // At the column X this is less by 256 dy for each.
        const std::int64_t at = edge.dx * units + edge.atOrigin;
        if (edge.perPixel > 0)
            first = std::max(first, -flooredSamples(at, edge.perPixel, edge.inverse));
        else if (edge.perPixel < 0)
            end = std::min(end, flooredSamples(at, -edge.perPixel, edge.inverse) + 1);
        else if (at < 0)
            end = x0;
    }
    WideRow row;
    row.y = y;
    row.x0 = static_cast<int>(std::min<std::int64_t>(first, x1));
    row.x1 = static_cast<int>(std::max<std::int64_t>(end, x0));
    row.depthAtReference = static_cast<float>(
        corners_[0].z + depthPerX_ * (referenceX() - startX_ / kSubpixels) +
        depthPerY_ * (static_cast<double>(units) - startY_));
    return row;
}

} // namespace gnomon::raster
