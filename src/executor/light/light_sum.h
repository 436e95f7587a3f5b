// Frames added up in linear light, and the picture of their mean: what antialiasing, penumbrae and sky light, and all
// else that is a mean of frames, come to.
#pragma once

#include "executor/executor.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::executor {

/// How the mean of light becomes a picture.
struct Shown {
    bool isShouldered = true;        // as block::Frame has it
    bool isTransparent = false;      // the background is: a pixel has the colour of what covers it
    std::vector<Rgb> backgroundRows; // from top to bottom
    bool hasGround = false;          // shadows may lie on the background
};

/// How `frame` shows light.
Shown shownAs(const FrameDrawing& frame);

/// Adds `other` light of the same surfaces to `light`, where both have some, and what shadows on the ground take.
void addLight(LightPicture& light, const LightPicture& other);

/// A sum of the light of frames of one size, as it reaches the eye: before the shoulder. It counts in 2^-20 of full
/// scale and, above 4,096 times that, as 4,096 times, so sums are whole numbers below 2^48: no order and no number of
/// threads changes them. Only what is shown of their mean is rounded to a screen's levels.
///
/// What lies behind the model is no light of it. A pixel's surfaces are shown by the mean of the frames in which they
/// cover it, and mixed with the background by the share of these frames in the linear light of the screen: the
/// brightest of backgrounds takes no more of an edge than it covers. A shadow on the ground takes as much of the
/// background's light as the mean of the frames has it; a transparent one is black, and covers by how dark it is.
class LightSum {
public:
    static constexpr int kMost = 65535;

    /// What an image of so many pixels holds at once while frames are added and shown: the sums, the light of a frame
    /// in and out of the shadow, and their copies; of a ground and of a sky that are summed, too.
    static Bytes bytes(std::uint64_t pixels, bool hasGround, bool hasSky);

    /// Begins anew with nothing, and gives back what there was. With `hasGround` it counts what shadows leave of the
    /// background. The frames hold the rows of the image from `firstRow` on, counted from the bottom.
    void reset(bool hasGround = false, int firstRow = 0);

    /// Adds one more, at most kMost in all and of the size of the first; where it is of some tiles, only what lies in
    /// them. All frames from the first such on are of these.
    void add(const LightPicture& light, const shadow::TileMask* tiles = nullptr);

    /// How many frames; those of some tiles count.
    int count() const { return count_; }

    /// The mean over the frames that cover a pixel.
    LightPicture mean() const;

    /// At least one frame; the rows of the background are those of the whole image. Of equal frames it is what each of
    /// them shows.
    Picture picture(const Shown& shown) const;

    /// The share of the frames that cover each pixel.
    Coverage coverage() const;

private:
    using Sums = std::array<std::uint64_t, 3>;

    void addPixel(std::size_t i, const std::array<float, 3>& pixel);
    int framesOf(std::size_t i) const;
    std::array<float, 3> leftOfBackground(std::size_t i) const;
    float groundCoverage(std::size_t i) const;

    int firstRow_ = 0;
    int count_ = 0;
    int whole_ = 0;                         // the frames before the first of some tiles
    std::optional<shadow::TileMask> tiles_; // of those from there on
    Raster<Sums> sums_;
    Raster<std::uint16_t> covered_; // by how many
    bool hasGround_ = false;
    Raster<Sums> shadows_; // what is missing of the background where it shows; empty without a ground
};

} // namespace gnomon::executor
