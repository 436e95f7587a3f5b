// A picture as a window takes it: of four bytes a pixel, and with more pixels than it was drawn with.
#pragma once

#include "executor/picture.h"

#include <array>

namespace gnomon::executor {

/// Red, green, blue and 255.
using WindowPicture = Raster<std::array<std::uint8_t, 4>>;

/// `picture` with `width` x `height` pixels, at least as many as it has each way, interpolated between the middles of
/// its own, bytes as they are shown.
WindowPicture upscaled(const Picture& picture, int width, int height);

} // namespace gnomon::executor
