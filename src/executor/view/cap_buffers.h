// Where the lines of a section plane are drawn before its caps are.
#pragma once

#include "executor/picture.h"

namespace gnomon::executor {

/// What a section plane shows at a pixel.
enum class CapKind : std::uint8_t {
    None,
    Solid,    // the inside of a closed surface
    Outline,  // where the plane meets that surface
    OpenEdge, // where it meets one that is not closed
};

/// The memory of an image of lines, all 0 between planes.
struct CapBuffers {
    Raster<int> windings; // by what differs along a row
    Raster<CapKind> kinds;
};

} // namespace gnomon::executor
