// What the vertices and clusters that an image shows carry, pixel by pixel: stored colours, errors, fields.
#pragma once

#include "executor/picture.h"
#include "frame/renderer.h"

#include <string>

namespace gnomon::values {

/// NaN where nothing of the model is seen.
using ValuePicture = executor::Raster<double>;

/// All are of `frame`, the last that `renderer` rendered, with `wantsSurfaces`; all throw Error where its executor is
/// not the software one, which alone knows what it shows.

/// The stored error of the cluster that is drawn, world units: that of the grid at the finest level.
ValuePicture seenErrors(const frame::Renderer& renderer, const frame::Frame& frame);

/// A field of the model between the vertices of the triangle that is seen; throws Error, with those there are, where
/// the model has none of this name, and where a page cannot be read again.
ValuePicture seenField(const frame::Renderer& renderer, const frame::Frame& frame, const std::string& name);

/// The stored colours likewise, black where nothing of the model is seen; throws Error where the model has none.
executor::Picture seenColors(const frame::Renderer& renderer, const frame::Frame& frame);

} // namespace gnomon::values
