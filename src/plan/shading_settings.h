// The settings for the shading, the background and the ground of an image.
#pragma once

#include "core/words.h"

#include <array>
#include <cstdint>

namespace gnomon::plan {

/// The light that shades the surfaces.
/// - Lit: the sun with its shadows, the sky and the ground.
/// - Flat: the light of Lit, with one normal per triangle.
/// - Headlight: a light at the eye.
/// - Unlit: colours without any light.
/// - Auto: Lit if the image has a ground or the sun reaches at least 0.5% of its pixels, otherwise Headlight.
enum class Shading : std::uint8_t { Auto, Lit, Headlight, Flat, Unlit };
inline constexpr std::array kShadings = {
    Word<Shading>{Shading::Auto, "auto"},
    Word<Shading>{Shading::Lit, "lit"},
    Word<Shading>{Shading::Headlight, "headlight"},
    Word<Shading>{Shading::Flat, "flat"},
    Word<Shading>{Shading::Unlit, "unlit"},
};

/// Returns true if `shading` has no sun, and thus no shadows.
constexpr bool hasNoSun(Shading shading) {
    return shading == Shading::Headlight || shading == Shading::Unlit;
}

/// The background: the colour of pixels without a surface.
struct Background {
    enum class Kind : std::uint8_t { Color, Sky, Transparent };
    Kind kind = Kind::Sky;
    std::array<std::uint8_t, 3> color{}; // sRGB; only for Kind::Color

    bool operator==(const Background&) const = default;
};

struct ShadingSettings {
    Shading shading = Shading::Auto;
    double ambient = 1; // factor for the light from sky and ground; 1: the default light
    Background background;
    bool ground = false; // true: shows the model's shadow on a plane under it; the plane itself is invisible

    bool operator==(const ShadingSettings&) const = default;
};

} // namespace gnomon::plan
