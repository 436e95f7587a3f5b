// The vertex stage for one vertex: projects a grid position to pixel coordinates and depth. The SIMD kernels use the
// same operations in the same order, so their results are bit-identical.
#pragma once

#include "raster/raster.h"

namespace gnomon::raster {

class RowBands;

/// Subpixels per pixel: vertices are snapped to multiples of 1/256 pixel. Pixel centres have integer coordinates.
constexpr int kSubpixelBits = 8;
constexpr int kSubpixels = 1 << kSubpixelBits;

/// Half the size of the guard band, in pixels from the centre of the viewport. Triangles that extend beyond the guard
/// band are clipped.
constexpr float kGuardPixels = 32768;

/// Min clip-space w of a vertex. A smaller w is too small for the perspective division.
constexpr float kMinW = 0x1p-100F;

/// Max absolute depth of a vertex, so that differences of depths stay finite. Pixel depths are later clamped to [0, 1].
constexpr float kDepthLimit = 0x1p30F;

/// The vertex stage parameters that all vertices of a pass share.
struct Projection {
    std::array<float, 16> clipFromCell{}; // column by column
    std::array<std::uint32_t, 3> eyeCell{};
    float guardX = 1; // guard band: |x| <= guardX w; a power of two, so the product is exact
    float guardY = 1;
    float scaleX = 0; // pixels = scale * ndc + translate
    float scaleY = 0;
    float translateX = 0;
    float translateY = 0;
    bool cutsDepth = false; // true: triangles are clipped at depth 0 and at depth w
    float lowX = -1;        // points with x < lowX w or x > highX w are outside the viewport
    float highX = 1;
    float lowY = -1; // the same limits for y
    float highY = 1;
    /// The row positions of a logarithmic map, or null if the rows are evenly spaced. With row positions, y of a
    /// snapped vertex stores the bits of y / w.
    const RowBands* rows = nullptr;
};

struct ClipPosition {
    float x = 0;
    float y = 0;
    float z = 0;
    float w = 0;
};

/// Number of bits of the rounding remainder of a snapped coordinate (unsnapped minus snapped). The depth plane of a
/// triangle uses the remainders, so that snapping does not change its slope. The covered pixels depend only on the
/// snapped corners.
constexpr int kRestBits = 16;

/// A vertex snapped to subpixels: x and y in 1/256 pixel (pixel centres at multiples of 256), and depth.
struct SnappedVertex {
    std::int32_t x = 0;
    std::int32_t y = 0;
    float z = 0;
    std::int16_t restX = 0; // remainder: unsnapped minus snapped x, in 2^-16 of 1/256 pixel
    std::int16_t restY = 0;
};

/// Min ratio of a triangle's area before snapping to its area after snapping. Below this ratio, the depth plane is
/// computed from the snapped corners.
constexpr float kMinTrueArea = 0.25F;

/// Converts a snapping remainder from integer units of 2^-16 to units of 1/256 pixel, exactly.
constexpr float restOf(std::int16_t rest) {
    return static_cast<float>(rest) * (1.0F / (1 << kRestBits));
}

/// Returns the vertex stage parameters for `view`. `rows` are the rows of a logarithmic map, or null for evenly spaced
/// rows.
Projection projection(const View& view, bool cutsDepth, const RowBands* rows = nullptr);

ClipPosition clipPosition(const Projection& projection, const std::uint32_t* position);

/// Snaps the clip-space position `p` to subpixels. `p` must be inside the guard band.
SnappedVertex snapped(const Projection& projection, const ClipPosition& p);

/// Snaps the position (x, y), in 1/256 pixel, with depth `z` to a vertex in whole subpixels.
SnappedVertex snappedTo(double x, double y, float z);

/// Returns a snapped vertex of a logarithmic map. Only `x` (in 1/256 pixel) is snapped; y / w and depth `z` are stored
/// unchanged.
SnappedVertex unevenTo(double x, float yOverW, float z);

/// Returns one bit per frustum plane. The bit is set if `p` is outside the plane. The planes are left, right, lower and
/// upper, and then near and far if depth is clipped.
std::uint32_t outsideBits(const Projection& projection, const ClipPosition& p);

} // namespace gnomon::raster
