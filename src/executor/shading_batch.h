// What the shading kernel reads and writes: pixels and points in batches, and what all of a frame share.
#pragma once

#include "shaders/shared/frame_block.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon::executor {

/// Pixels that are shaded together: what is seen there, and what comes of it.
struct PixelBatch {
    static constexpr std::size_t kMost = 128;

    template <class T>
    using Values = std::array<T, kMost>;
    template <class T>
    using Vectors = std::array<Values<T>, 3>;

    /// Fills up the last vector with copies of the last pixel.
    void pad();

    std::size_t count = 0;
    // What is seen: pixel centre; corner 0 in grid cells from draw space's origin; the edges from there to the others
    // in cells; the corners' normals and colours as pages hold them; the lit fraction, where it is known.
    Values<float> x{}, y{};
    Vectors<std::int32_t> corner{}, edge1{}, edge2{};
    Vectors<std::uint32_t> normals{}, colors{};
    Values<float> litMask{};
    // What comes of it.
    Vectors<float> position{};     // draw space
    Vectors<float> flatNormal{};   // towards the eye
    Vectors<float> shaded{};       // before any overlay
    Values<float> depth{};         // along the view
    Values<float> lit{};           // fraction; 0 where the surface is turned from the light
    Values<std::int32_t> pass{};   // the map that was looked up; -1: none
    Values<std::int32_t> faces{};  // -1 where the surface faces the light, else 0
    Values<std::uint32_t> color{}; // shaded as 8-bit RGB, red in the low byte
    // With LitSource::Undecided and Awaited, besides: the colour in the light, `color` being that in shadow.
    Values<std::uint32_t> litColor{};
    // With `wantsLight` what is reflected, linear RGB: that of `color` with LitSource::Undecided and Awaited is
    // `shadowLight`, and `light` that of `litColor`.
    Vectors<float> light{}, shadowLight{};
    // With Undecided the weights of corners 1 and 2.
    Values<float> second{}, third{};
    // With Awaited what is to be looked up in `pass`, once it is drawn: the first and the last texel of the kernel,
    // column and row of the depth texture, and the depth to compare with.
    Values<std::int32_t> firstColumn{}, firstRow{}, lastColumn{}, lastRow{};
    Values<float> lookupDepth{};
};

/// Points that are looked up in the maps together. What lies past `count` is computed too, and means nothing.
struct PointBatch {
    std::size_t count = 0;                   // at most PixelBatch::kMost
    PixelBatch::Vectors<float> position{};   // draw space
    PixelBatch::Vectors<float> normal{};     // of the surface, of length 1, on the viewer's side
    PixelBatch::Values<float> lit{};         // fraction; 0 where the surface is turned from the light
    PixelBatch::Values<std::int32_t> pass{}; // the map that was looked up; -1: none
};

/// Where the lit fraction of a pixel comes from. Undecided pixels get the colours of both verdicts, and so do those
/// whose lookups are awaited by maps that are still to be drawn.
enum class LitSource : std::uint8_t { Everywhere, Maps, Mask, Undecided, Awaited };

/// What all pixels of a frame share.
struct ShadingFrame {
    const block::Frame* frame = nullptr;
    const block::Shadows* shadows = nullptr;
    const float* shadowDepth = nullptr; // texels row by row; only with LitSource::Maps
    int shadowWidth = 0;                // texels
    LitSource litSource = LitSource::Everywhere;
    bool wantsLight = false;
    // Rays start where the image is seen from (grid cells from draw space's origin); the one through the image point
    // (x, y) in pixels has the direction first + x perX + y perY, of view depth 1.
    std::array<float, 3> rayOriginCells{};
    std::array<float, 3> rayFirst{};
    std::array<float, 3> rayPerX{};
    std::array<float, 3> rayPerY{};
    // Where lines of sight are parallel they begin there for the image point (0, 0) and move with it, cells a pixel.
    bool isParallel = false;
    std::array<float, 3> originPerX{};
    std::array<float, 3> originPerY{};
};

} // namespace gnomon::executor
