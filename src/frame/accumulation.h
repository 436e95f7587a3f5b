// A picture as the mean of frames that sample their pixels at other places: antialiasing.
#pragma once

#include "executor/light/picture_sum.h"
#include "frame/renderer.h"

namespace gnomon::frame {

/// Where frame `sample` of an accumulation, from 0, samples its pixels: pixels right and up of their middles, each at
/// least -1/2 and below 1/2. The first two dimensions of Sobol's sequence (1967), half a pixel around: the first is the
/// middle, and of the first 2^m each rectangle of the area 2^-m whose sides are powers of two holds one.
glm::dvec2 subpixelOffset(int sample);

/// The frames of a standing view, one after another, and the mean of their pictures.
class Accumulation {
public:
    /// Begins anew with `frame`, the last that `renderer` rendered, with `isAccumulated` and no offset. Both must
    /// outlive what is added. With `keepsCoverage` only what a surface covers counts, and how much of a pixel that is.
    void begin(Renderer& renderer, const Frame& frame, bool keepsCoverage);

    /// Forgets all of it.
    void clear() { sum_.reset(); }

    /// Draws one more frame and adds it.
    void add();

    /// How many frames there are.
    int samples() const { return sum_.count(); }

    executor::Picture picture() const { return sum_.mean(); }

    /// Nothing unless it is kept.
    std::optional<executor::Coverage> coverage() const { return sum_.coverage(); }

private:
    void take();

    Renderer* renderer_ = nullptr;
    const Frame* frame_ = nullptr;
    bool keepsCoverage_ = false;
    executor::PictureSum sum_;
};

} // namespace gnomon::frame
