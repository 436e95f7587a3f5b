// Buffers for drawing the intersection lines of a section plane, from which the caps of the section are filled.
#pragma once

#include "render/picture.h"

namespace gnomon::render {

/// The part of a section's cap that a pixel shows.
enum class CapKind : std::uint8_t {
    None,
    Solid,    // the inside of a closed surface
    Outline,  // intersection of the plane with a closed surface
    OpenEdge, // intersection of the plane with an open surface
};

/// The buffers for the lines of one section plane in the image. Before each plane, all values are 0.
struct CapBuffers {
    Raster<int> windings; // change of the winding number along a row
    Raster<CapKind> kinds;
};

} // namespace gnomon::render
