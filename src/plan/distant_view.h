// Converts an orthographic view to a perspective view with a distant eye and a small angle of view. The planning,
// culling and drawing of a frame use this perspective view.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Distance of the distant eye from the model, in multiples of the visible size. Within the model, the lines of sight
/// then diverge by less than 1/256 of the image to each side.
inline constexpr double kDistantSizes = 256;

/// Visible size at the far end of the model divided by the visible size at its near end, for a distant eye: 1 + 1/255.
inline constexpr double kDistantGrowth = (kDistantSizes + 0.5) / (kDistantSizes - 0.5);

/// Returns a perspective view that replaces the orthographic `view` in planning, culling and drawing. A view that is
/// already perspective is returned unchanged.
///
/// For a model within `bounds`, the eye moves back along the view direction. The target moves to the near end of the
/// model. The angle of view is chosen so that the image has its requested size there. The perspective view therefore
/// contains everything that the orthographic image shows. A pixel covers between 1 and kDistantGrowth times its
/// requested size. Only the drawing of the image uses parallel lines of sight.
///
/// Throws Error if the camera is invalid.
View distantView(const View& view, const Box& bounds);

/// Returns `quality` with its near and far depths converted from the eye of the requested view `asked` to the eye of
/// the perspective view `distant`.
Quality distantQuality(const Quality& quality, const View& asked, const View& distant);

} // namespace gnomon::plan
