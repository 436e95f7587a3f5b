// Pictures in number: the names of their files, and the stream that video encoders read.
#pragma once

#include "executor/picture.h"

#include <optional>
#include <string>

namespace gnomon::executor {

/// `pattern` with `number` in place of its one "%d" or "%04d" (of any width below 10); nothing if it has none, more
/// than one, or a percent sign of another kind.
std::optional<std::string> numberedName(const std::string& pattern, int number);

/// The head of a YUV4MPEG2 stream of pictures of that size, progressive, square pixels, 4:4:4, limited range. Pictures
/// of odd sizes have no other format.
std::string y4mHeader(int width, int height, double framesPerSecond);

/// `picture` as a frame of such a stream: BT.709 in the range 16 to 235. A stream cannot name its matrix, so encoders
/// must be told (docs/looks.md).
std::string y4mFrame(const Picture& picture);

} // namespace gnomon::executor
