// What the exact shadows of a prepared frame will take, before anything of it is drawn.
#pragma once

#include "frame/prepared_frame.h"

namespace gnomon::frame {

/// The work that deciding the shadows of `frame` exactly is predicted to take; `frame` is planned and cut for them.
plan::ExactWork predictedWork(const PreparedFrame& frame);

} // namespace gnomon::frame
