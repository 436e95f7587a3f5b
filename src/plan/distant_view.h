// Conversion of an orthographic view to a perspective view with a distant eye and a small angle. The plan uses this
// perspective view.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Distance of the eye from the model, in multiples of the visible size. Over the model, the lines of sight then
/// diverge by less than 1/256 of the image to each side.
inline constexpr double kDistantSizes = 256;

/// Size of the visible region of such an eye at the far end of the model divided by its size at the near end: 1 +
/// 1/255.
inline constexpr double kDistantGrowth = (kDistantSizes + 0.5) / (kDistantSizes - 0.5);

/// Returns the view that the program plans, culls and draws. A perspective view and a distant view are returned
/// unchanged.
///
/// For an orthographic view of a model within `bounds`, the eye moves back along the view direction. The angle becomes
/// so small that the image has its requested size at the near end of the model, where the target then is. The
/// perspective view therefore contains everything that the parallel image shows. A pixel covers between 1 and
/// kDistantGrowth times its requested size. Only the drawing of the image uses parallel lines of sight.
///
/// Throws Error if the camera is invalid.
View distantView(const View& view, const Box& bounds);

/// Returns `quality` for the view `distant`. The given depths in `quality` are measured from the eye of `asked`; the
/// result measures them from the eye of `distant`.
Quality distantQuality(const Quality& quality, const View& asked, const View& distant);

} // namespace gnomon::plan
