// A picture whose colours tell a value of the surface, with its legend.
#pragma once

#include "executor/overlay/legend.h"
#include "executor/picture.h"
#include "frame/renderer.h"
#include "settings/value_colors.h"

namespace gnomon::values {

/// The heights of a model's lowest and highest place along `up`, which has any length above 0; source coordinates.
std::array<double, 2> heightRange(const Box& bounds, const glm::dvec3& up);

/// Height along `up` of `position` (world space), or the angle of a surface with `normal` (of length 1, either side)
/// to the level, degrees.
double valueOf(settings::ColorBy by, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& up);

/// The scale that `colors` ask for, where the value has all of `usual`. Errors, and fields above 0 that span more than
/// a decade, go by their logarithm, and usually no lower than their greatest over kScaleSpan: a linear scale from 0
/// cannot part factors of two near its end, however it is coloured.
executor::ValueScale valueScale(const settings::ValueColors& colors, const std::array<double, 2>& usual);

/// Gives the surfaces of `frame`, the last that `renderer` rendered, with `wantsSurfaces`, the colours of their values
/// in `picture`, darker where the light does not reach, and draws the legend, which stored colours have none of.
/// `colors.by` is not None. Throws Error as seen_values.h says.
void colorByValues(
    const settings::ValueColors& colors,
    const frame::Renderer& renderer,
    const frame::Frame& frame,
    executor::Picture& picture);

} // namespace gnomon::values
