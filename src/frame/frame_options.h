// How a frame is drawn, besides its view and its quality.
#pragma once

#include "executor/executor.h"

#include <memory>
#include <optional>

namespace gnomon::frame {

/// How frames treat what is not resident.
enum class Waiting : std::uint8_t {
    UntilComplete, // a frame waits until its cut is resident, and nothing is prefetched: everything but times repeats
    Never,         // a frame draws what is there; pages are prefetched along the motion
};

/// How a frame is drawn, besides view and quality.
struct FrameOptions {
    Waiting waiting = Waiting::UntilComplete;
    executor::Overlay overlay = executor::Overlay::None;
    bool wantsSurfaces = false;           // keep what the executor's `surfaces` returns
    bool reusesMaps = true;               // where the frame before left the very same ones
    bool wantsWholeMaps = false;          // to be looked at besides this image: receivers cull none of their casters
    bool wantsWholeImage = false;         // to be looked at besides its colours: it is drawn in no bands
    std::optional<Camera> observerCamera; // sees the frame of the view from outside: its cut, its casters, its maps
    glm::dvec2 subpixel{0};               // where pixels are sampled, as FrameDrawing has it; at most half a pixel off
    bool isAccumulated = false;           // `drawSample` is to follow: the cut has a `margin`, maps are whole, and the
                                          // executor keeps the light
    glm::dvec2 mapShift{0};               // of the grids of all shadow maps, as ShadowMap has it
    executor::LightPart lightPart = executor::LightPart::All;
    double skyWeight = 0;                          // as FrameDrawing has it
    std::optional<glm::vec3> groundShade;          // likewise
    std::shared_ptr<const shadow::TileMask> tiles; // likewise
    std::optional<executor::ImageRows> rows;       // likewise

    /// Pixels by which the cut reaches beyond the image on each side.
    double margin() const { return isAccumulated ? 0.5 : 0; }

    bool operator==(const FrameOptions&) const = default;
};

} // namespace gnomon::frame
