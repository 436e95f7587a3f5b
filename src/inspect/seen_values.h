// Images of values that the visible vertices and clusters store: colours, errors and fields.
#pragma once

#include "frame/renderer.h"
#include "render/picture.h"

#include <string>

namespace gnomon::inspect {

/// An image with one value per pixel, which is NaN where the model is not visible.
using ValuePicture = render::Raster<double>;

/// All functions below need the last frame that `renderer` rendered, with FrameOptions::wantsSurfaces. They throw Error
/// for a backend other than the software backend, because only the software backend stores the visible surfaces.

/// Returns an image with the stored error of the cluster that each pixel shows, in world units. At the finest level it
/// is the error of the grid.
ValuePicture seenErrors(const frame::Renderer& renderer, const frame::Frame& frame);

/// Returns an image of the model's field `name`, interpolated between the vertices of the visible triangle. Throws
/// Error, with the names of the existing fields, if the model has no such field. Also throws Error if a page cannot be
/// read again.
ValuePicture seenField(const frame::Renderer& renderer, const frame::Frame& frame, const std::string& name);

/// Returns an image of the colours that the model stores, interpolated between the vertices of the visible triangle.
/// Pixels without the model are black. Throws Error if the model has no colours.
render::Picture seenColors(const frame::Renderer& renderer, const frame::Frame& frame);

} // namespace gnomon::inspect
