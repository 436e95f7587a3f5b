// The options of a frame besides its view and quality.
#pragma once

#include "render/backend.h"

#include <memory>
#include <optional>

namespace gnomon::frame {

/// The treatment of pages that are not resident.
enum class Waiting : std::uint8_t {
    // A frame waits until its cut is resident, and prefetches no pages. All results except times are then reproducible.
    UntilComplete,
    // A frame draws the resident pages, and prefetches pages along the motion.
    Never,
};

/// The options of a frame besides its view and quality.
struct FrameOptions {
    Waiting waiting = Waiting::UntilComplete;
    render::Overlay overlay = render::Overlay::None;
    bool wantsSurfaces = false; // stores the result of the backend's `surfaces`
    bool reusesMaps = true;     // reuses maps that are identical to maps of the previous frame
    // the caller also reads the maps themselves, so receivers cull no casters
    bool wantsWholeMaps = false;
    // the caller also reads other data than the colours, so the image is not drawn in bands
    bool wantsWholeImage = false;
    // shows the view's frame from another camera: its cut, its casters and its maps
    std::optional<Camera> observerCamera;
    glm::dvec2 subpixel{0}; // sample position as in DrawInputs, at most half a pixel from the centre
    // `drawSample` will follow: the cut has a `margin`, maps are complete, and the backend stores the light
    bool isAccumulated = false;
    glm::dvec2 mapShift{0}; // shift of the texel grids of all maps, as in ShadowMap
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
