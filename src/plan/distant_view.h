// Parallel lines of sight as the limit of a small angle: the eye that an orthographic view is planned for.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// From how many times the size of what is seen a parallel view is planned. Over a model, lines from there part by less
/// than 1/256 of the image, to either side.
inline constexpr double kDistantSizes = 256;

/// How much larger what such an eye sees is at the far end of a model than at the near one: 1 part in 255.
inline constexpr double kDistantGrowth = (kDistantSizes + 0.5) / (kDistantSizes - 0.5);

/// A view as it is planned, culled and drawn. A perspective one is itself. An orthographic one of a model within
/// `bounds` has its eye moved back along the view, and an angle so small that the image is as large as it was asked for
/// where the model begins, which is its target: so what it sees holds all that the parallel image shows, each pixel as
/// large as it is there or up to kDistantGrowth times as large. Only the image itself is drawn by parallel lines. A
/// distant view is its own. Throws Error for an impossible camera.
View distantView(const View& view, const Box& bounds);

/// `quality`, whose given depths are from the eye of the view that was asked for, for the view that came of it.
Quality distantQuality(const Quality& quality, const View& asked, const View& distant);

} // namespace gnomon::plan
