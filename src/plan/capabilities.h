// What a backend can draw. This is the only list: settings, plans, frames, the window and the bench read it.
#pragma once

namespace gnomon::plan {

/// The effects that not every backend can draw.
struct Capabilities {
    bool exactShadows = false;     // decides the shadow of each visible point exactly
    bool unevenRows = false;       // draws maps whose rows are logarithmic
    bool imageFirst = false;       // finds the visible points before it draws maps, so receivers can cull casters
    bool occlusionCulling = false; // draws an image without its hidden clusters
    bool ground = false;           // draws the shadow on the ground
    bool sections = false;         // cuts models by planes
    bool bands = false;            // draws some rows of an image at a time
    bool seesTriangles = false; // knows the triangle of each pixel, so colours can follow vertices, errors and fields

    bool operator==(const Capabilities&) const = default;
};

/// The capabilities of the software backend.
inline constexpr Capabilities kSoftwareCapabilities = {
    .exactShadows = true,
    .unevenRows = true,
    .imageFirst = true,
    .occlusionCulling = true,
    .ground = true,
    .sections = true,
    .bands = true,
    .seesTriangles = true};

/// The capabilities of the backends that draw with OpenGL.
inline constexpr Capabilities kOpenGlCapabilities = {};

} // namespace gnomon::plan
