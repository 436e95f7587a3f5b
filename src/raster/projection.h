// From a grid position to a pixel: the vertex stage, one vertex at a time. The vector kernels repeat these operations
// in this order, to the bit.
#pragma once

#include "raster/raster.h"

namespace gnomon::raster {

class RowBands;

/// Subpixels of a pixel. Snapped coordinates are multiples of 1/256 pixel, with pixel centres at whole pixels.
constexpr int kSubpixelBits = 8;
constexpr int kSubpixels = 1 << kSubpixelBits;

/// A vertex is left whole up to about this many pixels from the middle of the viewport; triangles beyond are cut.
constexpr float kGuardPixels = 32768;

/// Below this w a vertex is not divided.
constexpr float kLeastW = 0x1p-100F;

/// Depths of vertices are held within this, so that differences stay finite; pixels are clamped much closer.
constexpr float kDepthLimit = 0x1p30F;

/// What a pass does to each vertex.
struct Projection {
    std::array<float, 16> clipFromCell{}; // columns
    std::array<std::uint32_t, 3> eyeCell{};
    float guardX = 1; // |x| <= guardX w; powers of two, so that the product is exact
    float guardY = 1;
    float scaleX = 0; // pixels = scale * ndc + translate
    float scaleY = 0;
    float translateX = 0;
    float translateY = 0;
    bool cutsDepth = false; // at 0 and at w
    float lowX = -1;        // what is left of lowX w or right of highX w is outside
    float highX = 1;
    float lowY = -1; // likewise
    float highY = 1;
    const RowBands* rows = nullptr; // where rows lie unevenly; y of snapped vertices then holds the bits of y / w
};

struct ClipPosition {
    float x = 0;
    float y = 0;
    float z = 0;
    float w = 0;
};

/// Snapping decides what is covered; depth keeps what it cut off, so that a slope does not move with the corners.
constexpr int kRestBits = 16;

/// A vertex in the plane of the target: 1/256 pixels (pixel centres at multiples of 256), and depth.
struct SnappedVertex {
    std::int32_t x = 0;
    std::int32_t y = 0;
    float z = 0;
    std::int16_t restX = 0; // unsnapped less snapped, in 2^-16 of 1/256 pixel
    std::int16_t restY = 0;
};

/// Where snapping left less than this share of a triangle's area, its plane of depth is that of the snapped corners.
constexpr float kLeastTrueArea = 0.25F;

/// A rest in 1/256 pixel, exact.
constexpr float restOf(std::int16_t rest) {
    return static_cast<float>(rest) * (1.0F / (1 << kRestBits));
}

/// `rows` are those of `view` where they lie unevenly.
Projection projection(const View& view, bool cutsDepth, const RowBands* rows = nullptr);

ClipPosition clipPosition(const Projection& projection, const std::uint32_t* position);

/// For vertices inside the guard.
SnappedVertex snapped(const Projection& projection, const ClipPosition& p);

/// The vertex at (x, y) in 1/256 pixel.
SnappedVertex snappedTo(double x, double y, float z);

/// The vertex at x in 1/256 pixel where rows lie unevenly.
SnappedVertex unevenTo(double x, float yOverW, float z);

/// Bits of the frustum's planes that a vertex is outside of: left, right, lower, upper, and where depth is cut near,
/// far.
std::uint32_t outsideBits(const Projection& projection, const ClipPosition& p);

} // namespace gnomon::raster
