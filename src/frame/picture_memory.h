// Computes the memory of a frame's image, without the model. An image that is too large is drawn in bands of rows.
#pragma once

#include "frame/frame_options.h"
#include "plan/frame_plan.h"

#include <vector>

namespace gnomon::frame {

/// Returns the memory that the software backend needs to draw a frame of `view` and average it with other frames. The
/// result includes:
/// - the buffers per pixel, for the rows in `options`,
/// - the finished image,
/// - the samples of exact shadows, as if the sun reached every pixel,
/// - the shadow maps, and the grid cells into which exact shadows sort their samples.
Bytes pictureBytes(const plan::View& view, const plan::Quality& quality, const FrameOptions& options);

/// Returns the bands of rows in which an image of `view` is drawn within `memory`, from the bottom. The result is a
/// single band if the whole image fits into half of the memory, or if the frame cannot be drawn in bands. Otherwise a
/// band needs at most a quarter of the memory, but has at least 64 rows. The bands do not change the bytes of the
/// image.
std::vector<render::ImageRows> bandsOf(
    const plan::View& view, const plan::Quality& quality, const FrameOptions& options, Bytes memory);

} // namespace gnomon::frame
