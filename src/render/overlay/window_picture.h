// A picture in the pixel format that window systems require.
#pragma once

#include "render/picture.h"

#include <cstdint>

namespace gnomon::render {

/// A picture with one 32-bit word per pixel: 255, red, green and blue from the highest to the lowest byte. Window
/// systems require this format.
using WindowPicture = Raster<std::uint32_t>;

/// Converts `picture` to the pixel format of windows. The result overwrites `words` and reuses its memory.
void takePicture(const Picture& picture, WindowPicture& words);

} // namespace gnomon::render
