// The kinds of shadows, and the reasons for them.
#pragma once

#include "core/words.h"

#include <array>
#include <cstdint>

namespace gnomon::plan {

/// The kinds of shadows. Maps looks up shadow maps, Exact decides each visible point in integers, Rays traces rays.
/// Auto is one of the others: `decideShadows` says which.
enum class ShadowMode : std::uint8_t { Off, Maps, Exact, Rays, Auto };
inline constexpr std::array kShadowModes = {
    Word<ShadowMode>{ShadowMode::Off, "off"},
    Word<ShadowMode>{ShadowMode::Maps, "maps"},
    Word<ShadowMode>{ShadowMode::Exact, "exact"},
    Word<ShadowMode>{ShadowMode::Rays, "rays"},
    Word<ShadowMode>{ShadowMode::Auto, "auto"},
};

/// The reason for the kind of shadows of a frame.
enum class ShadowReason : std::uint8_t {
    Requested,      // by its name
    NoSun,          // the shading has no sun, so nothing casts shadows
    MapsRequested,  // by an option, an overlay or a proof of shadow maps
    FrameTime,      // exact shadows take longer than the frame time that the window aims at
    BackendHasMaps, // the backend draws shadow maps only
    BackendIsExact, // the backend draws exact shadows
};

} // namespace gnomon::plan
