// Lists the optional effects that a backend can draw. All other code asks only this list, not the type of the backend.
#pragma once

namespace gnomon::plan {

/// The optional effects of a backend. False means that the backend cannot draw the effect.
struct Capabilities {
    bool exactShadows = false;     // computes the shadow of each visible point exactly
    bool unevenRows = false;       // draws logarithmic maps
    bool imageFirst = false;       // finds the visible points before it draws maps, so that receivers can cull casters
    bool occlusionCulling = false; // skips the hidden clusters of an image
    bool ground = false;           // draws the shadow of the model on the ground
    bool sections = false;         // cuts models by planes
    bool bands = false;            // draws only a range of the rows of an image at a time
    // knows the triangle of each pixel, so that colours can show vertices, errors and fields
    bool seesTriangles = false;

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
