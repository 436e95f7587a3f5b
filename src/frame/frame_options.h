// The options for drawing a frame, besides its view and quality settings.
#pragma once

#include "render/backend.h"

#include <memory>
#include <optional>

namespace gnomon::frame {

/// Whether a frame waits for missing model pages to be loaded.
enum class Waiting : std::uint8_t {
    // Waits until all pages of the frame's clusters are in memory, and prefetches no pages. All results except times
    // are then reproducible.
    UntilComplete,
    // Draws the pages in memory at once, and prefetches pages along the camera motion.
    Never,
};

/// The options for drawing a frame, besides its view and quality settings.
struct FrameOptions {
    Waiting waiting = Waiting::UntilComplete;
    render::Overlay overlay = render::Overlay::None;
    bool wantsSurfaces = false; // true: stores the visible surfaces, which the backend's function `surfaces` returns
    bool reusesMaps = true;     // reuses the shadow maps of the previous frame if they are identical
    // true: the caller reads the shadow maps, so the maps contain all casters, without culling by receivers
    bool wantsWholeMaps = false;
    // true: the caller reads other data than the colours, so the image is not drawn in bands of rows
    bool wantsWholeImage = false;
    // Second camera that draws the image. Clusters, casters and shadow maps are still selected for the camera of the
    // view, so the image shows them from another position.
    std::optional<Camera> observerCamera;
    // sample position relative to each pixel's centre, in pixels to the right and up, each at most 1/2
    glm::dvec2 subpixel{0};
    // true: more frames with other subpixel positions will follow (`drawSample`). The clusters then cover a margin
    // around the image, the maps are complete, and the backend stores the light.
    bool isAccumulated = false;
    // shift of the texel grids of all shadow maps, in columns and rows, each at most half a texel
    glm::dvec2 mapShift{0};
    render::LightPart lightPart = render::LightPart::All;
    double skyWeight = 0; // weight of the light from one sky direction, as in DrawInputs
    // fraction of the background's light that the ground's shadow removes, per channel
    std::optional<glm::vec3> groundShade;
    std::shared_ptr<const shadow::TileMask> tiles; // image tiles to draw; null: all tiles
    std::optional<render::ImageRows> rows;         // image rows to draw; nullopt: all rows

    /// Returns the width, in pixels, of the margin around the image in which clusters are also selected.
    double margin() const { return isAccumulated ? 0.5 : 0; }

    bool operator==(const FrameOptions&) const = default;
};

} // namespace gnomon::frame
