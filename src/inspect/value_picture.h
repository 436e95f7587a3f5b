// Draws pictures whose colours show a value of the surface such as height or slope, with a legend.
#pragma once

#include "frame/renderer.h"
#include "render/overlay/legend.h"
#include "render/picture.h"
#include "settings/value_colors.h"

namespace gnomon::inspect {

/// Returns the heights of a model's lowest and highest point along `up`, in source coordinates. `up` has any length
/// above 0.
std::array<double, 2> heightRange(const Box& bounds, const glm::dvec3& up);

/// Returns the value of a surface point that `by` names: its height along `up`, or the slope of the surface in degrees.
/// `position` is in world space. `normal` has length 1 and points to either side of the surface.
double valueOf(settings::ColorBy by, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& up);

/// Returns the scale that maps values to colours, as `colors` requests. `usual` is the range of the values if no range
/// is requested. Errors have a logarithmic scale. Positive fields that span more than a decade also have one, because a
/// linear scale from 0 cannot distinguish factors of two near its end. Without a requested range, a logarithmic scale
/// spans at most a factor of kScaleSpan.
render::ValueScale valueScale(const settings::ValueColors& colors, const std::array<double, 2>& usual);

/// Colours the surfaces in `picture` by the value that `colors` name, and draws the legend. Surfaces in shadow are
/// darker. `frame` must be the last frame that `renderer` rendered, with `wantsSurfaces`. The colours that a model
/// stores have no legend. `colors.by` must not be None. Throws the errors of seen_values.h.
void colorByValues(
    const settings::ValueColors& colors,
    const frame::Renderer& renderer,
    const frame::Frame& frame,
    render::Picture& picture);

} // namespace gnomon::inspect
