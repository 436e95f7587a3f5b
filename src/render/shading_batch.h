// The input and output of the shading kernel: batches of pixels and points, and the constants of a frame.
#pragma once

#include "shaders/shared/frame_block.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon::render {

/// A batch of pixels that are shaded together, with input and results.
struct PixelBatch {
    static constexpr std::size_t kMaxPixels = 128;

    template <class T>
    using Values = std::array<T, kMaxPixels>;
    template <class T>
    using Vectors = std::array<Values<T>, 3>;

    /// Fills the last vector with copies of the last pixel.
    void pad();

    std::size_t count = 0;
    // Input: the pixel centre; corner 0 of the triangle in grid cells from the origin of camera-relative space; the
    // edges from this corner in cells; the normals and colours of the corners in page format; and the lit fraction, if
    // it is known.
    Values<float> x{}, y{};
    Vectors<std::int32_t> corner{}, edge1{}, edge2{};
    Vectors<std::uint32_t> normals{}, colors{};
    Values<float> litMask{};
    // Results:
    Vectors<float> position{};     // camera-relative space
    Vectors<float> flatNormal{};   // towards the eye
    Vectors<float> shaded{};       // before the overlay
    Values<float> depth{};         // along the view
    Values<float> lit{};           // lit fraction; 0 if the surface faces away from the light
    Values<std::int32_t> pass{};   // index of the looked-up map; -1: none
    Values<std::int32_t> faces{};  // -1 if the surface faces the light, otherwise 0
    Values<std::uint32_t> color{}; // shaded 8-bit RGB, red in the low byte
    // With LitSource::Awaited: the lit colour. `color` is then the colour in shadow.
    Values<std::uint32_t> litColor{};
    Vectors<float> light{}; // with `wantsLight`: the reflected linear RGB
    // With LitSource::Unresolved: the weights of corners 1 and 2. `depth` is then the only other result.
    Values<float> second{}, third{};
    // With Awaited: the later lookup in map `pass`, which is not drawn yet. It has the first and the last texel of the
    // filter kernel (column and row of the depth texture) and the depth for the comparison.
    Values<std::int32_t> firstColumn{}, firstRow{}, lastColumn{}, lastRow{};
    Values<float> lookupDepth{};
};

/// A batch of points for lookups in the maps. Entries after `count` are computed too, but meaningless.
struct PointBatch {
    std::size_t count = 0;                   // at most PixelBatch::kMaxPixels
    PixelBatch::Vectors<float> position{};   // camera-relative space
    PixelBatch::Vectors<float> normal{};     // unit normal of the surface, towards the viewer
    PixelBatch::Values<float> lit{};         // lit fraction; 0 if the surface faces away from the light
    PixelBatch::Values<std::int32_t> pass{}; // index of the looked-up map; -1: none
};

/// The source of a pixel's lit fraction. An Unresolved pixel gets no colour, because its exact shadow is not computed
/// yet. An Awaited pixel, whose map is not drawn yet, gets both its lit and its shadowed colour.
enum class LitSource : std::uint8_t { Everywhere, Maps, Mask, Unresolved, Awaited };

/// The constants of a frame for all pixels.
struct ShadingFrame {
    const block::Frame* frame = nullptr;
    const block::Shadows* shadows = nullptr;
    const float* shadowDepth = nullptr; // texels row by row; only with LitSource::Maps
    int shadowWidth = 0;                // in texels
    LitSource litSource = LitSource::Everywhere;
    bool wantsLight = false;
    // Primary rays start at rayOriginCells (grid cells from the origin of camera-relative space). The ray through the
    // image point (x, y), in pixels, has the direction first + x perX + y perY, whose view depth is 1.
    std::array<float, 3> rayOriginCells{};
    std::array<float, 3> rayFirst{};
    std::array<float, 3> rayPerX{};
    std::array<float, 3> rayPerY{};
    // Parallel rays start at rayOriginCells for the image point (0, 0). Their origin moves with the image point, in
    // cells per pixel.
    bool isParallel = false;
    std::array<float, 3> originPerX{};
    std::array<float, 3> originPerY{};
};

} // namespace gnomon::render
