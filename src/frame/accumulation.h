// A picture as the mean of frames, each of which samples its pixels elsewhere and takes its light from elsewhere:
// antialiasing, penumbrae and the light of the sky, in one sum of linear light.
#pragma once

#include "executor/light/background.h"
#include "executor/light/light_sum.h"
#include "frame/renderer.h"

namespace gnomon::frame {

/// Where frame `sample` of an accumulation, from 0, samples its pixels: pixels right and up of their middles, each at
/// least -1/2 and below 1/2. The first two dimensions of Sobol's sequence (1967), half a pixel around: the first is the
/// middle, and of the first 2^m each rectangle of the area 2^-m whose sides are powers of two holds one.
glm::dvec2 subpixelOffset(int sample);

/// Where frame `sample` of an accumulation, from 0, moves the grids of its shadow maps: texels, each at least -1/2 and
/// below 1/2, the first 0. The R2 sequence (Roberts 2018), which has no pattern in common with `subpixelOffset`.
glm::dvec2 mapShift(int sample);

/// The frames of a standing view, one after another, and the mean of their pictures. Where the plan of the first calls
/// for directions of the light's disc each has one, and where it calls for those of the sky each is the sum of two
/// drawings: in the light of the sun, of the ground and from the eye, and in that of a part of the sky. Frames that
/// there are for the disc alone are drawn in the tiles of the plan's penumbrae alone.
class Accumulation {
public:
    /// Begins anew with `frame`, the last that `renderer` drew, with `isAccumulated` and no offset. Both must outlive
    /// what is added. There are to be `samples` frames, at least 1, or as many as the directions that its plan calls
    /// for, if those are more; without sky, the first `samples`, and
    /// at least plan::leastFirstPoints, are of all tiles.
    void begin(Renderer& renderer, const Frame& frame, int samples);

    /// Forgets all of it.
    void clear() { sum_.reset(); }

    /// Draws one more frame and adds it; there are less than `wanted`.
    void add();

    /// How many frames there are.
    int samples() const { return sum_.count(); }

    /// How many there are to be: the directions are spread over so many.
    int wanted() const { return wanted_; }

    /// The mean, before it is shown.
    executor::LightPicture light() const { return sum_.mean(); }

    executor::Picture picture() const { return sum_.picture(shown_); }

    /// Nothing unless the background is transparent.
    std::optional<executor::Coverage> coverage() const {
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
    int whole_ = 1; // of them, the first: those of all tiles
    executor::GroundShares onGround_;
    executor::Shown shown_;
    executor::LightSum sum_;
};

} // namespace gnomon::frame
