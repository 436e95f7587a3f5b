// Pictures whose colours show a value of the surface, with a legend.
#pragma once

#include "frame/renderer.h"
#include "render/overlay/legend.h"
#include "render/picture.h"
#include "settings/value_colors.h"

namespace gnomon::inspect {

/// Returns the heights of a model's lowest and highest point along `up`, which has any length above 0. Heights are in
/// source coordinates.
std::array<double, 2> heightRange(const Box& bounds, const glm::dvec3& up);

/// Returns the height of `position` (world space) along `up`, or the slope of a surface in degrees. `normal` has length
/// 1 and points to either side.
double valueOf(settings::ColorBy by, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& up);

/// Returns the scale that maps values to colours, as `colors` requests. `usual` is the range of the values if no range
/// is requested. Errors have a logarithmic scale. Positive fields that span more than a decade have one too, because a
/// linear scale from 0 cannot distinguish factors of two near its end. Without a requested range, a logarithmic scale
/// spans at most a factor of kScaleSpan.
render::ValueScale valueScale(const settings::ValueColors& colors, const std::array<double, 2>& usual);

/// Colours the surfaces of `frame` in `picture` by their values and draws the legend. Surfaces in shadow are darker.
/// `frame` must be the last frame that `renderer` rendered, with `wantsSurfaces`. Stored colours have no legend.
/// `colors.by` must not be None. Throws the errors of seen_values.h.
void colorByValues(
    const settings::ValueColors& colors,
    const frame::Renderer& renderer,
    const frame::Frame& frame,
    render::Picture& picture);

} // namespace gnomon::inspect
