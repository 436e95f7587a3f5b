// Values of the visible vertices and clusters per pixel: stored colours, errors and fields.
#pragma once

#include "executor/picture.h"
#include "frame/renderer.h"

#include <string>

namespace gnomon::values {

/// A value per pixel; NaN where the model is not visible.
using ValuePicture = executor::Raster<double>;

/// In these functions, `frame` must be the last frame that `renderer` rendered, with `wantsSurfaces`. They throw Error
/// with another executor than the software one, because only that executor stores the visible surfaces.

/// Returns the stored error of the drawn cluster, in world units. At the finest level it is the error of the grid.
ValuePicture seenErrors(const frame::Renderer& renderer, const frame::Frame& frame);

/// Returns a field of the model, interpolated between the vertices of the visible triangle. Throws Error, with the
/// names of the existing fields, if the model has no field `name`. Also throws Error if a page cannot be read again.
ValuePicture seenField(const frame::Renderer& renderer, const frame::Frame& frame, const std::string& name);

/// Returns the stored colours, interpolated in the same way, and black where the model is not visible. Throws Error if
/// the model has no colours.
executor::Picture seenColors(const frame::Renderer& renderer, const frame::Frame& frame);

} // namespace gnomon::values
