// The shadow class of each pixel of a picture: lit, dark, facing away from the light, within tolerance, or background.
#pragma once

#include "render/backend.h"

namespace gnomon::validation {

/// The shadow class of a pixel. The values are grey levels of the file of --shadow-classes.
enum class ShadowClass : std::uint8_t {
    Dark = 0,
    FacesAway = 64,        // the surface faces away from the light
    WithinTolerance = 128, // the result depends on the tolerance or on the rule for ties; ground truth only
    Background = 192,      // no surface
    Lit = 255
};

/// Returns the class of each pixel as the picture shows it. A pixel is lit if at least half of its filter kernel is
/// lit.
render::Raster<ShadowClass> drawnClasses(const render::Raster<render::SurfaceSample>& surfaces);

/// Returns the class of each pixel by `statuses`, the result of render::statusesByIntegers for the same frame.
render::Raster<ShadowClass> trueClasses(
    const render::Raster<render::SurfaceSample>& surfaces, const render::Raster<std::uint8_t>& statuses);

/// Returns `classes` as a grey picture.
render::Picture pictureOf(const render::Raster<ShadowClass>& classes);

} // namespace gnomon::validation
