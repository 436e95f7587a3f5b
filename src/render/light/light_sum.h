// Sums of frames in linear light, and the picture of their mean. Antialiasing, penumbrae and sky light are such means.
#pragma once

#include "render/backend.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::render {

/// Parameters for the conversion of mean light to a picture.
struct ToneMapping {
    bool isToneMapped = true; // applies tone mapping, as in block::Frame
    // The background is transparent, so a partly covered pixel has the colour of its surface only.
    bool isTransparent = false;
    std::vector<Rgb> backgroundRows; // from top to bottom
    bool hasGround = false;          // the background can show shadows
};

/// Returns the parameters for pictures of `frame`.
ToneMapping toneMappingOf(const DrawInputs& frame);

/// Adds the light `other` of the same surfaces to `light` at pixels where both have a surface. Also adds the shares
/// that ground shadows remove.
void addLight(LightPicture& light, const LightPicture& other);

/// A sum of the light of frames of one size, before tone mapping. Light is counted in units of 2^-20 of full scale, and
/// clamped to 4096 times full scale. Sums are therefore integers below 2^48, and independent of order and number of
/// threads. Only the displayed mean is rounded to the levels of a screen.
/// The background is not part of the light. The surfaces of a pixel have the mean over the frames in which they cover
/// it. This share of the frames then blends surface and background in displayed linear light, so a very bright
/// background does not eat into edges. A shadow on the ground removes its mean share of the background's light. On a
/// transparent background, a ground shadow is black and its darkness is the coverage.
class LightSum {
public:
    static constexpr int kMaxPictures = 65535;

    /// Returns the peak memory for an image with `pixels` pixels: the sums, the light of a frame, and copies. Ground
    /// and sky need more.
    static Bytes bytes(std::uint64_t pixels, bool hasGround, bool hasSky);

    /// Clears the sum and frees its memory. With `hasGround`, also sums ground shadows. The frames contain the rows of
    /// the image from `firstRow` on, counted from the bottom.
    void reset(bool hasGround = false, int firstRow = 0);

    /// Adds a frame of the same size as the first; at most kMaxPictures frames. With `tiles`, adds only the pixels of
    /// these tiles. All later frames must then have the same tiles.
    void add(const LightPicture& light, const shadow::TileMask* tiles = nullptr);

    /// Returns the number of frames, including frames of tiles.
    int count() const { return count_; }

    /// Returns the mean light over the frames that cover a pixel.
    LightPicture mean() const;

    /// Returns the picture of the mean. Requires at least one frame. The background rows are those of the whole image.
    /// The mean of equal frames is the picture of each of them.
    Picture picture(const ToneMapping& shown) const;

    /// Returns the share of the frames that cover each pixel.
    Coverage coverage() const;

private:
    using Sums = std::array<std::uint64_t, 3>;

    void addPixel(std::size_t i, const std::array<float, 3>& pixel);
    int framesOf(std::size_t i) const;
    std::array<float, 3> leftOfBackground(std::size_t i) const;
    float groundCoverage(std::size_t i) const;

    int firstRow_ = 0;
    int count_ = 0;
    int whole_ = 0;                         // frames before the first frame of tiles
    std::optional<shadow::TileMask> tiles_; // tiles of all later frames
    Raster<Sums> sums_;
    Raster<std::uint16_t> covered_; // number of frames that cover the pixel
    bool hasGround_ = false;
    Raster<Sums> shadows_; // removed light of the visible background; empty without a ground
};

} // namespace gnomon::render
