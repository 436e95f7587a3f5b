// The overlays: visualisations of shadows and levels of detail that are painted over an image.
#pragma once

#include <array>
#include <cstdint>

namespace gnomon::render {

/// A visualisation that is painted over the image.
/// - Aliasing shows the perspective aliasing, for which a plan has a bound.
/// - Projection shows the projection aliasing. It depends on the angles of the surface to light and eye, and has no
/// bound.
/// - Residency shows clusters that are coarser than requested, because finer pages are not in memory.
enum class Overlay : std::uint8_t { None, Partitions, Texels, Aliasing, Lod, Clusters, Projection, Residency };

/// An overlay, its name on the command line, and its title in the window.
struct NamedOverlay {
    Overlay value;
    const char* word;
    const char* title;
};

/// All overlays, in the order of the window's menu.
inline constexpr std::array kOverlays = {
    NamedOverlay{Overlay::None, "none", "none"},
    NamedOverlay{Overlay::Partitions, "partitions", "partitions"},
    NamedOverlay{Overlay::Texels, "texels", "shadow texels"},
    NamedOverlay{Overlay::Aliasing, "aliasing", "aliasing"},
    NamedOverlay{Overlay::Lod, "lod", "level of detail"},
    NamedOverlay{Overlay::Clusters, "clusters", "clusters"},
    NamedOverlay{Overlay::Residency, "residency", "what waits for pages"},
    NamedOverlay{Overlay::Projection, "projection", "projection"},
};

/// Returns true if `overlay` shows a property of shadow maps.
constexpr bool isOfMaps(Overlay overlay) {
    return overlay == Overlay::Partitions || overlay == Overlay::Texels || overlay == Overlay::Aliasing ||
           overlay == Overlay::Projection;
}

/// Returns the title of `overlay` for display.
constexpr const char* title(Overlay overlay) {
    for (const NamedOverlay& each : kOverlays)
        if (each.value == overlay) return each.title;
    return "";
}

} // namespace gnomon::render
