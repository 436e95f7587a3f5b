// A triangle of any size in a logarithmic shadow map: computes the covered pixels of a row with 64-bit integers, and
// the depth plane.
#pragma once

#include "raster/uneven/row_bands.h"
#include "raster/wide_triangle.h"

#include <algorithm>
#include <cmath>

namespace gnomon::raster {

/// A vertex of a logarithmic shadow map, snapped to the units of one band of rows.
struct UnevenVertex {
    std::int32_t x = 0; // 1/256 pixel
    std::int64_t y = 0; // units of the band
    double restX = 0;   // remainder: unsnapped minus snapped x, in 1/256 pixel
    double unsnappedY = 0;
    float z = 0;
};

/// Snaps `vertex` to the units of `band`. The y of `vertex` stores the bits of y / w.
UnevenVertex unevenVertex(const RowBand& band, const SnappedVertex& vertex);

/// The largest absolute quotient for which flooredSamples is exact, a power of two. All pixel indices of a target are
/// smaller.
constexpr double kFarSamples = 0x1p30;

/// A triangle of a logarithmic shadow map with counter-clockwise corners (y up). The constructor accepts the corners in
/// either order.
class UnevenTriangle {
public:
    explicit UnevenTriangle(std::array<UnevenVertex, 3> corners);

    bool hasArea() const { return hasArea_; }

    /// Returns true if a pixel centre of `box` may be inside the triangle. The rows of `box` must belong to `band`.
    bool mayTouch(const RowBand& band, const PixelBox& box) const;

    /// Returns the covered pixels of row `y` of the target, in columns x0 to x1 - 1, with their depths. The row must
    /// belong to `band`.
    WideRow row(const RowBand& band, int y, int x0, int x1) const;

    int referenceX() const { return corners_[0].x >> kSubpixelBits; }

    float depthPerX() const { return static_cast<float>(depthPerX_); }

    float minDepth() const { return minDepth_; }

    float maxDepth() const { return maxDepth_; }

private:
    /// An edge function of the triangle. A pixel centre (X, Y) is inside if dx Y - dy X + atOrigin >= 0.
    struct Edge {
        std::int64_t dx = 0;
        std::int64_t dy = 0;
        std::int64_t atOrigin = 0;
        std::int64_t perPixel = 0; // -256 dy, the increment per column
        double inverse = 0;        // 1 / |perPixel|
    };

    void setPlane(bool isTrue);

    std::array<UnevenVertex, 3> corners_;
    std::array<Edge, 3> edges_;
    bool hasArea_ = false;
    double depthPerX_ = 0; // change of depth per pixel
    double depthPerY_ = 0; // change of depth per unit of the band
    double startX_ = 0;    // corner 0, where the depth plane starts: x in 1/256 pixel, y in units of the band
    double startY_ = 0;
    float minDepth_ = 0; // smallest depth of the corners, clamped to [0, 1]
    float maxDepth_ = 0;
};

/// Returns the floor of a / b for b > 0, with `inverse` = 1 / b. Quotients beyond kFarSamples are clamped to
/// kFarSamples. The function corrects a floating-point estimate, which is wrong by at most one.
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
        // The edge function decreases by 256 dy per pixel column.
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
