// The options of a frame besides its view and quality.
#pragma once

#include "render/backend.h"

#include <memory>
#include <optional>

namespace gnomon::frame {

/// The treatment of pages of a frame's cut that are not resident.
enum class Waiting : std::uint8_t {
    // Waits until all pages of the cut are resident, and prefetches no pages. All results except times are then
    // reproducible.
    UntilComplete,
    // Draws the resident pages at once, and prefetches pages along the camera motion.
    Never,
};

/// The options of a frame besides its view and quality.
struct FrameOptions {
    Waiting waiting = Waiting::UntilComplete;
    render::Overlay overlay = render::Overlay::None;
    bool wantsSurfaces = false; // stores the visible surfaces for the backend's `surfaces`
    bool reusesMaps = true;     // reuses the shadow maps of the previous frame if they are identical
    // the caller reads the shadow maps, so receivers must not cull casters
    bool wantsWholeMaps = false;
    // the caller reads other data than the colours, so the image is not drawn in bands of rows
    bool wantsWholeImage = false;
    // another camera that shows the frame of the view: clusters, casters and maps stay those of the view
    std::optional<Camera> observerCamera;
    glm::dvec2 subpixel{0}; // sample position as in DrawInputs, at most half a pixel from the centre
    // calls of `drawSample` will follow: the cut has a `margin`, the maps are complete, and the backend stores the
    // light
    bool isAccumulated = false;
    glm::dvec2 mapShift{0}; // shift of the texel grids of all maps, in texels, as in ShadowMap
    render::LightPart lightPart = render::LightPart::All;
    double skyWeight = 0;                          // as in DrawInputs
    std::optional<glm::vec3> groundShade;          // as in DrawInputs
    std::shared_ptr<const shadow::TileMask> tiles; // as in DrawInputs
    std::optional<render::ImageRows> rows;         // as in DrawInputs

    /// Returns the pixels by which the cut extends beyond the image on each side.
    double margin() const { return isAccumulated ? 0.5 : 0; }

    bool operator==(const FrameOptions&) const = default;
};

} // namespace gnomon::frame
