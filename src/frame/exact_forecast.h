// What the exact shadows of a prepared frame will take, before anything of it is drawn.
#pragma once

#include "exact/exact_shadows.h"
#include "frame/exact_estimate.h"
#include "frame/prepared_frame.h"
#include "frame/residency.h"

namespace gnomon::frame {

/// The least error, in pixels, of the clusters by which `predictedWork` knows a frame of `errorPixels`.
double predictedErrorPixels(const plan::View& view, double errorPixels);

/// The work that deciding the shadows of `frame` exactly is predicted to take; none where it has nothing to decide.
/// `frame` is planned and cut for exact shadows, its pages are resident, `drawing` is what the executor would get.
plan::ExactWork predictedWork(
    const PreparedFrame& frame,
    const executor::FrameDrawing& drawing,
    const Residency& residency,
    ExactEstimate& estimate);

/// Of `predicted` the triangles cast and the sample tests once more, when the image is drawn and the first eighth of
/// the casters are cast: the weighted geometric mean with what these let one expect.
plan::ExactWork refinedWork(const plan::ExactWork& predicted, const exact::CastForecast& forecast);

} // namespace gnomon::frame
