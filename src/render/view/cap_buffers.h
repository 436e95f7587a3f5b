// Buffers for the lines of a section plane, from which its caps are made.
#pragma once

#include "render/picture.h"

namespace gnomon::render {

/// The part of a section plane that a pixel shows.
enum class CapKind : std::uint8_t {
    None,
    Solid,    // inside of a closed surface
    Outline,  // intersection of the plane with a closed surface
    OpenEdge, // intersection of the plane with an open surface
};

/// The buffers of an image of lines. All values are 0 between planes.
struct CapBuffers {
    Raster<int> windings; // change of the winding number along a row
    Raster<CapKind> kinds;
};

} // namespace gnomon::render
