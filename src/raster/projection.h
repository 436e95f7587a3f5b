// The vertex stage for one vertex: from a grid position to a pixel. The vector kernels repeat these operations in the
// same order, so their results are identical to the last bit.
#pragma once

#include "raster/raster.h"

namespace gnomon::raster {

class RowBands;

/// Subpixels per pixel. Snapped coordinates are multiples of 1/256 pixel, and pixel centres have integer coordinates.
constexpr int kSubpixelBits = 8;
constexpr int kSubpixels = 1 << kSubpixelBits;

/// Size of the guard band, in pixels from the centre of the viewport. Triangles that reach outside are clipped.
constexpr float kGuardPixels = 32768;

/// The smallest w that permits the division by w.
constexpr float kMinW = 0x1p-100F;

/// Max absolute depth of a vertex, so that differences stay finite. Each pixel's depth is clamped further.
constexpr float kDepthLimit = 0x1p30F;

/// The parameters of a pass for the vertex stage.
struct Projection {
    std::array<float, 16> clipFromCell{}; // column by column
    std::array<std::uint32_t, 3> eyeCell{};
    float guardX = 1; // guard band: |x| <= guardX w; a power of two, so the product is exact
    float guardY = 1;
    float scaleX = 0; // pixels = scale * ndc + translate
    float scaleY = 0;
    float translateX = 0;
    float translateY = 0;
    bool cutsDepth = false; // true: clip at depth 0 and at depth w
    float lowX = -1;        // points left of lowX w or right of highX w are outside
    float highX = 1;
    float lowY = -1; // the same for y
    float highY = 1;
    /// The rows, if their spacing is uneven. The y of snapped vertices then stores the bits of y / w.
    const RowBands* rows = nullptr;
};

struct ClipPosition {
    float x = 0;
    float y = 0;
    float z = 0;
    float w = 0;
};

/// Number of bits for the rest of a snapped position. Snapping determines the covered pixels. The depth plane also uses
/// the rest, so that the slope of a plane does not change with the snapped corners.
constexpr int kRestBits = 16;

/// A vertex snapped to the target: x and y in 1/256 pixel (pixel centres at multiples of 256), and depth.
struct SnappedVertex {
    std::int32_t x = 0;
    std::int32_t y = 0;
    float z = 0;
    std::int16_t restX = 0; // unsnapped minus snapped x, in 2^-16 of 1/256 pixel
    std::int16_t restY = 0;
};

/// Min ratio of the unsnapped to the snapped area of a triangle. Below it, the depth plane goes through the snapped
/// corners.
constexpr float kMinTrueArea = 0.25F;

/// Returns a rest in units of 1/256 pixel, exactly.
constexpr float restOf(std::int16_t rest) {
    return static_cast<float>(rest) * (1.0F / (1 << kRestBits));
}

/// Returns the projection of `view`. `rows` are the rows of the view if their spacing is uneven.
Projection projection(const View& view, bool cutsDepth, const RowBands* rows = nullptr);

ClipPosition clipPosition(const Projection& projection, const std::uint32_t* position);

/// Returns the snapped vertex of `p`, which must be inside the guard band.
SnappedVertex snapped(const Projection& projection, const ClipPosition& p);

/// Returns the vertex at (x, y), in 1/256 pixel.
SnappedVertex snappedTo(double x, double y, float z);

/// Returns the vertex at `x` (1/256 pixel) and `yOverW`, for uneven rows.
SnappedVertex unevenTo(double x, float yOverW, float z);

/// Returns one bit per frustum plane that the vertex is outside of: left, right, lower, upper, and near and far if
/// depth is clipped.
std::uint32_t outsideBits(const Projection& projection, const ClipPosition& p);

} // namespace gnomon::raster
