// Averages several frames with different subpixel positions and light directions into one image. The mean is computed
// in linear light. It gives antialiasing, penumbrae and sky light.
#pragma once

#include "frame/renderer.h"
#include "render/light/background.h"
#include "render/light/light_sum.h"

namespace gnomon::frame {

/// Returns the subpixel position of frame `sample` (0, 1, ...) of an averaged image, relative to the pixel's centre.
/// The unit is pixels to the right and up, each in [-1/2, 1/2). The positions are the first two dimensions of the Sobol
/// sequence (1967), shifted by half a pixel, so the first position is the centre. Each elementary rectangle with area
/// 2^-m contains exactly one of the first 2^m positions.
glm::dvec2 subpixelOffset(int sample);

/// Returns the shift of the texel grids of all shadow maps in frame `sample` (0, 1, ...) of an averaged image. The unit
/// is texels, each in [-1/2, 1/2). The first shift is 0. The shifts are the R2 sequence (Roberts 2018), which does not
/// correlate with `subpixelOffset`.
glm::dvec2 mapShift(int sample);

/// Averages several frames of one view. For a sun with a disc, each frame is lit from one point of the disc. For sky
/// light, each frame is the sum of two images: the first image has the light of the sun, the ground and the headlight,
/// and the second image has the light of one sky sample. Frames that only add points of the disc are drawn only in the
/// image tiles with penumbrae.
class Accumulation {
public:
    /// Starts a new mean with `frame`, which must be the last frame of `renderer`, with `isAccumulated` and without a
    /// subpixel offset. `renderer` and `frame` must exist until the last call of `add`. The number of frames is
    /// `samples` (at least 1), or the number of light directions in the frame's plan if that is larger. With sky light,
    /// all frames are drawn in all image tiles. Without sky light, the first max(samples, plan::minFirstPoints) frames
    /// are drawn in all tiles.
    void begin(Renderer& renderer, const Frame& frame, int samples);

    /// Removes all accumulated frames.
    void clear() { sum_.reset(); }

    /// Draws one more frame and adds it to the mean. Requires `samples()` < `wanted()`.
    void add();

    /// Returns the number of accumulated frames.
    int samples() const { return sum_.count(); }

    /// Returns the number of frames of the complete mean. The light directions are distributed over these frames.
    int wanted() const { return wanted_; }

    /// Returns the mean light of the accumulated frames, before tone mapping.
    render::LightPicture light() const { return sum_.mean(); }

    render::Picture picture() const { return sum_.picture(shown_); }

    /// Returns the mean coverage of the pixels, or nullopt if the background is not transparent.
    std::optional<render::Coverage> coverage() const {
        return shown_.isTransparent ? std::optional(sum_.coverage()) : std::nullopt;
    }

private:
    void leaveSkyOut(FrameOptions& options) const;
    const std::shared_ptr<const shadow::TileMask>& tilesOf(int sample) const;
    void drawSunlit(int sample);
    void take(int sample);

    const plan::FramePlan& plan() const { return frame_->plan; }

    Renderer* renderer_ = nullptr;
    const Frame* frame_ = nullptr;
    int wanted_ = 1;
    int whole_ = 1; // the first `whole_` frames are drawn in all image tiles
    render::GroundShares onGround_;
    render::ToneMapping shown_;
    render::LightSum sum_;
};

} // namespace gnomon::frame
