// The types of shadows, and the reasons for choosing them.
#pragma once

#include "core/words.h"

#include <array>
#include <cstdint>

namespace gnomon::plan {

/// The types of shadows. Maps looks up shadow maps, Exact tests each visible point with integers, and Rays traces rays.
/// `chooseShadows` replaces Auto by one of the other types.
enum class ShadowMode : std::uint8_t { Off, Maps, Exact, Rays, Auto };
inline constexpr std::array kShadowModes = {
    Word<ShadowMode>{ShadowMode::Off, "off"},
    Word<ShadowMode>{ShadowMode::Maps, "maps"},
    Word<ShadowMode>{ShadowMode::Exact, "exact"},
    Word<ShadowMode>{ShadowMode::Rays, "rays"},
    Word<ShadowMode>{ShadowMode::Auto, "auto"},
};

/// The reason why a frame has its type of shadows.
enum class ShadowReason : std::uint8_t {
    Requested,      // the user requested this type
    NoSun,          // the shading has no sun, so nothing casts shadows
    MapsRequested,  // an option, an overlay or a validation of shadow maps needs maps
    FrameTime,      // exact shadows take longer than the target frame time of the window
    BackendHasMaps, // the backend draws only shadow maps
    BackendIsExact, // the backend draws exact shadows
};

} // namespace gnomon::plan
