// Sums the light of frames, and computes the picture of their mean. Antialiasing, penumbrae and sky light are such
// means.
#pragma once

#include "render/backend.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::render {

/// Parameters for the conversion of mean linear light to a picture.
struct ToneMapping {
    bool isToneMapped = true; // true: tone mapping is applied, as in block::Frame
    // true: the background is transparent, so a partly covered pixel has the colour of its surface only
    bool isTransparent = false;
    std::vector<Rgb> backgroundRows; // colour per row, from top to bottom
    bool hasGround = false;          // true: shadows on the ground can darken the background
};

/// Returns the parameters for pictures of `frame`.
ToneMapping toneMappingOf(const DrawInputs& frame);

/// Adds the light of `other` to `light`, for pixels where both have a surface. For pixels where neither has a surface,
/// adds the fractions that ground shadows remove.
void addLight(LightPicture& light, const LightPicture& other);

/// A sum of the light of frames of equal size, before tone mapping. Light is stored in units of 2^-20 of full scale,
/// and clamped to 4096 times full scale. The sums are therefore integers below 2^48, and do not depend on the order of
/// frames or the number of threads. Only the displayed mean is rounded to 8-bit levels.
///
/// The sum does not contain the light of the background. The surface light of a pixel is the mean over the frames in
/// which a surface covers the pixel. The fraction of these frames blends surface and background. The blending uses
/// displayed linear light, so a very bright background does not make edges thinner. A shadow on the ground removes its
/// mean fraction of the background's light. On a transparent background, a ground shadow is black, and its darkness is
/// the coverage.
class LightSum {
public:
    static constexpr int kMaxPictures = 65535;

    /// Returns the peak memory for an image with `pixels` pixels: the sums, the light of a frame, and copies. A ground
    /// and sky light need additional memory.
    static Bytes bytes(std::uint64_t pixels, bool hasGround, bool hasSky);

    /// Clears the sum and frees its memory. With `hasGround`, the light that ground shadows remove is also summed. The
    /// frames contain the rows of the image from `firstRow` on, counted from the bottom.
    void reset(bool hasGround = false, int firstRow = 0);

    /// Adds a frame. All frames must have the same size, and at most kMaxPictures frames can be added. With `tiles`,
    /// adds only the pixels in these tiles. All later frames must then have the same tiles.
    void add(const LightPicture& light, const shadow::TileMask* tiles = nullptr);

    /// Returns the number of added frames, including frames with tiles.
    int count() const { return count_; }

    /// Returns the mean light of each pixel, over the frames in which a surface covers the pixel.
    LightPicture mean() const;

    /// Returns the picture of the mean. At least one frame must have been added. `shown` has the background of all rows
    /// of the whole image. If all frames are equal, the picture is the picture of each frame.
    Picture picture(const ToneMapping& shown) const;

    /// Returns the coverage of each pixel: the fraction of the frames in which a surface covers the pixel.
    Coverage coverage() const;

private:
    using Sums = std::array<std::uint64_t, 3>;

    void addPixel(std::size_t i, const std::array<float, 3>& pixel);
    int framesOf(std::size_t i) const;
    std::array<float, 3> leftOfBackground(std::size_t i) const;
    float groundCoverage(std::size_t i) const;

    int firstRow_ = 0;
    int count_ = 0;
    int whole_ = 0;                         // number of frames before the first frame with tiles
    std::optional<shadow::TileMask> tiles_; // tiles of all later frames
    Raster<Sums> sums_;
    Raster<std::uint16_t> covered_; // number of frames that cover the pixel
    bool hasGround_ = false;
    Raster<Sums> shadows_; // light that ground shadows remove from the visible background; empty without a ground
};

} // namespace gnomon::render
