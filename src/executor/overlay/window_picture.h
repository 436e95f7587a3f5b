// A picture as a window takes it.
#pragma once

#include "executor/picture.h"

#include <cstdint>

namespace gnomon::executor {

/// A word a pixel: 255, red, green and blue from the highest byte to the lowest, which is how window systems have it.
using WindowPicture = Raster<std::uint32_t>;

/// Makes `words` what `picture` is; its memory is kept.
void takePicture(const Picture& picture, WindowPicture& words);

} // namespace gnomon::executor
