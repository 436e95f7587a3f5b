// What the image of a frame takes in memory beside the pages of its model, and the bands that it is drawn in if it is
// too large.
#pragma once

#include "frame/frame_options.h"
#include "plan/frame_plan.h"

#include <vector>

namespace gnomon::frame {

/// What drawing and adding up a frame of `view` with the software backend takes, for the rows that `options` name and
/// the finished picture: buffers by pixel, samples of exact shadows as if the sun reached every pixel, shadow maps and
/// cells.
Bytes pictureBytes(const plan::View& view, const plan::Quality& quality, const FrameOptions& options);

/// The bands in which a picture of `view` is drawn if it may take `memory`, from the bottom. Returns one band of all
/// rows if that fits into half of the memory, or if the frame cannot be drawn in bands. Else a band takes at most a
/// quarter of the memory, but has at least 64 rows. The picture is the same to the byte however many bands there are.
std::vector<executor::ImageRows> bandsOf(
    const plan::View& view, const plan::Quality& quality, const FrameOptions& options, Bytes memory);

} // namespace gnomon::frame
