// A picture in the pixel format of windows.
#pragma once

#include "render/picture.h"

#include <cstdint>

namespace gnomon::render {

/// One word per pixel with 255, red, green and blue from the highest to the lowest byte, as in window systems.
using WindowPicture = Raster<std::uint32_t>;

/// Converts `picture` to `words`, and reuses the memory of `words`.
void takePicture(const Picture& picture, WindowPicture& words);

} // namespace gnomon::render
