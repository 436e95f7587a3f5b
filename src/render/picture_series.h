// File names for a series of pictures, and a raw video stream for video encoders.
#pragma once

#include "render/picture.h"

#include <optional>
#include <string>

namespace gnomon::render {

/// Returns `pattern` with `number` inserted at its field "%d" or "%04d" (any width below 10). Returns nullopt if the
/// pattern has no field, several fields, or another percent sign.
std::optional<std::string> numberedName(const std::string& pattern, int number);

/// Returns the header of a YUV4MPEG2 video stream with progressive frames, square pixels, 4:4:4 chroma and limited
/// range. 4:4:4 is the only chroma format that also supports odd widths and heights.
std::string y4mHeader(int width, int height, double framesPerSecond);

/// Converts `picture` to a frame of a YUV4MPEG2 video stream, in BT.709 with the range 16 to 235. Such a stream cannot
/// store its colour matrix, so encoders need an option for it (docs/looks.md).
std::string y4mFrame(const Picture& picture);

} // namespace gnomon::render
