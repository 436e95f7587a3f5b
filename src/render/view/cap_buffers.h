// Buffers for the cap of a section plane: the filled cut that closes a solid model where the plane cuts it.
#pragma once

#include "render/picture.h"

namespace gnomon::render {

/// The part of a section's cap that is visible at a pixel.
enum class CapKind : std::uint8_t {
    None,
    Solid,    // the inside of a closed surface
    Outline,  // intersection of the plane with a closed surface
    OpenEdge, // intersection of the plane with an open surface
};

/// The intersection lines of one section plane with the model, drawn into an image. Before each plane, all values are
/// 0.
struct CapBuffers {
    Raster<int> windings; // change of the winding number along a row
    Raster<CapKind> kinds;
};

} // namespace gnomon::render
