// What the exact shadows of a prepared frame will take, before anything of it is drawn.
#pragma once

#include "frame/exact_estimate.h"
#include "frame/prepared_frame.h"
#include "frame/residency.h"

namespace gnomon::frame {

/// The work that deciding the shadows of `frame` exactly is predicted to take; none where it has nothing to decide.
/// `frame` is planned and cut for exact shadows, its pages are resident, `drawing` is what the executor would get.
plan::ExactWork predictedWork(
    const PreparedFrame& frame,
    const executor::FrameDrawing& drawing,
    const Residency& residency,
    ExactEstimate& estimate);

} // namespace gnomon::frame
