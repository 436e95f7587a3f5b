// The input and output of the SIMD shading kernel: batches of pixels, batches of points, and the constants of a frame.
#pragma once

#include "shaders/shared/frame_block.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon::render {

/// A batch of pixels that the SIMD kernel shades together, with input and results per pixel.
struct PixelBatch {
    static constexpr std::size_t kMaxPixels = 128;

    template <class T>
    using Values = std::array<T, kMaxPixels>;
    template <class T>
    using Vectors = std::array<Values<T>, 3>;

    /// Fills up the last SIMD vector with copies of the last pixel.
    void pad();

    std::size_t count = 0;
    // Input per pixel: the pixel centre; corner 0 of its triangle in grid cells from the origin of camera-relative
    // space; the edges from corner 0 in cells; normals and colours of the corners as stored in pages; and the lit
    // fraction, if it is known.
    Values<float> x{}, y{};
    Vectors<std::int32_t> corner{}, edge1{}, edge2{};
    Vectors<std::uint32_t> normals{}, colors{};
    Values<float> litMask{};
    // Results per pixel:
    Vectors<float> position{};     // camera-relative space
    Vectors<float> flatNormal{};   // normal of the triangle, towards the eye
    Vectors<float> shaded{};       // colour without the overlay
    Values<float> depth{};         // view depth
    Values<float> lit{};           // lit fraction; 0 if the surface faces away from the light
    Values<std::int32_t> pass{};   // index of the shadow map for the lookup; -1: none
    Values<std::int32_t> faces{};  // -1 if the surface faces the light, otherwise 0
    Values<std::uint32_t> color{}; // shaded 8-bit RGB, red in the low byte
    // With LitSource::Awaited, `litColor` is the colour of the pixel if it is lit, and `color` is its colour in
    // shadow.
    Values<std::uint32_t> litColor{};
    Vectors<float> light{}; // with `wantsLight`: the reflected light, linear RGB
    // With LitSource::Unresolved: the barycentric weights of the visible point for corners 1 and 2. All other results
    // except `depth` are then undefined.
    Values<float> second{}, third{};
    // With LitSource::Awaited: the shadow map lookup to do when map `pass` is drawn. The parameters are the first and
    // the last texel of the filter kernel (column and row of the depth texture), and the depth to compare.
    Values<std::int32_t> firstColumn{}, firstRow{}, lastColumn{}, lastRow{};
    Values<float> lookupDepth{};
};

/// A batch of points whose shadows are looked up in the shadow maps. The kernel also computes entries after `count`,
/// but their results are meaningless.
struct PointBatch {
    std::size_t count = 0;                   // at most PixelBatch::kMaxPixels
    PixelBatch::Vectors<float> position{};   // camera-relative space
    PixelBatch::Vectors<float> normal{};     // unit normal of the surface, towards the viewer
    PixelBatch::Values<float> lit{};         // lit fraction; 0 if the surface faces away from the light
    PixelBatch::Values<std::int32_t> pass{}; // index of the shadow map for the lookup; -1: none
};

/// The source of a pixel's lit fraction. With Unresolved, exact shadows are computed later, so the pixel receives no
/// colour yet. With Awaited, the shadow maps are drawn later, so the pixel receives both its lit colour and its colour
/// in shadow.
enum class LitSource : std::uint8_t { Everywhere, Maps, Mask, Unresolved, Awaited };

/// The constants of a frame for the shading kernel. They are the same for all pixels.
struct ShadingFrame {
    const block::Frame* frame = nullptr;
    const block::Shadows* shadows = nullptr;
    const float* shadowDepth = nullptr; // depth texture, row by row; only with LitSource::Maps
    int shadowWidth = 0;                // in texels
    LitSource litSource = LitSource::Everywhere;
    bool wantsLight = false;
    // The primary ray through the image point (x, y), in pixels. The ray starts at rayOriginCells, in grid cells from
    // the origin of camera-relative space. Its direction is first + x perX + y perY, which has view depth 1.
    std::array<float, 3> rayOriginCells{};
    std::array<float, 3> rayFirst{};
    std::array<float, 3> rayPerX{};
    std::array<float, 3> rayPerY{};
    // In an orthographic image, the ray through the image point (0, 0) starts at rayOriginCells. From pixel to pixel,
    // the start of the ray changes by originPerX and originPerY, in cells.
    bool isParallel = false;
    std::array<float, 3> originPerX{};
    std::array<float, 3> originPerY{};
};

} // namespace gnomon::render
