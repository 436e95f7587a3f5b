// Sums the light of several frames and computes the mean image. Such means give antialiasing, penumbrae and skylight.
#pragma once

#include "render/backend.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::render {

/// Parameters for converting the mean linear light of several frames to a picture.
struct ToneMapping {
    bool isToneMapped = true; // true: tone mapping is applied, as in block::Frame
    // True if the background is transparent. A partly covered pixel then has the colour of its surface only.
    bool isTransparent = false;
    std::vector<Rgb> backgroundRows; // colour per row, from top to bottom
    bool hasGround = false;          // true: shadows on the ground can darken the background
};

/// Returns the parameters for converting the light of `frame` to a picture.
ToneMapping toneMappingOf(const DrawInputs& frame);

/// Adds the light of `other` to `light` for pixels where both images have a surface. Where neither has a surface, the
/// function adds the fractions that ground shadows remove.
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

    /// Returns the peak memory of a light sum for an image with `pixels` pixels, including the light of one frame and
    /// copies. A ground and skylight need additional memory.
    static Bytes bytes(std::uint64_t pixels, bool hasGround, bool hasSky);

    /// Clears the sum and frees its memory. If `hasGround`, the sum includes the light that ground shadows remove.
    /// Frames contain the rows of the image from `firstRow` on, counted from the bottom.
    void reset(bool hasGround = false, int firstRow = 0);

    /// Adds the light of one frame. All frames must have the same size, and at most kMaxPictures frames can be added.
    /// With `tiles`, only the pixels in these tiles are added. All later frames must then have the same tiles.
    void add(const LightPicture& light, const shadow::TileMask* tiles = nullptr);

    /// Returns the number of added frames, including frames of which only tiles were added.
    int count() const { return count_; }

    /// Returns the mean light of each pixel over all frames in which a surface covers the pixel.
    LightPicture mean() const;

    /// Returns the picture of the mean light. At least one frame must have been added. `shown` contains the background
    /// of all rows of the image. If all frames are equal, the result equals the picture of one frame.
    Picture picture(const ToneMapping& shown) const;

    /// Returns the coverage of each pixel: the fraction of frames in which a surface covers the pixel.
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
