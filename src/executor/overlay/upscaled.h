// A picture shown with more pixels than it was drawn with.
#pragma once

#include "executor/picture.h"

namespace gnomon::executor {

/// `picture` with `width` x `height` pixels, at least as many as it has each way, interpolated between the middles of
/// its own, bytes as they are shown.
Picture upscaled(const Picture& picture, int width, int height);

} // namespace gnomon::executor
