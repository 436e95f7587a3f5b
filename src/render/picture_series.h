// Series of pictures: their file names, and a video stream for encoders.
#pragma once

#include "render/picture.h"

#include <optional>
#include <string>

namespace gnomon::render {

/// Returns `pattern` with `number` instead of its single "%d" or "%04d" (any width below 10). Returns nullopt if the
/// pattern has no or several such fields, or another percent sign.
std::optional<std::string> numberedName(const std::string& pattern, int number);

/// Returns the header of a YUV4MPEG2 stream: progressive, square pixels, 4:4:4, limited range. 4:4:4 is the only format
/// that also supports odd sizes.
std::string y4mHeader(int width, int height, double framesPerSecond);

/// Returns `picture` as a frame of this stream, in BT.709 with the range 16 to 235. A stream cannot store its colour
/// matrix, so encoders need an option (docs/looks.md).
std::string y4mFrame(const Picture& picture);

} // namespace gnomon::render
