// What the picture looks like besides its shadows: where the light of a surface comes from, what lies behind it and
// under it. Of all this a plan depends on the ground alone.
#pragma once

#include "core/words.h"

#include <array>
#include <cstdint>

namespace gnomon::plan {

/// Where the light of a surface comes from. Lit: the sun, where no shadow lies, the sky and the ground. Flat: likewise,
/// with each triangle's own normal. Headlight: the eye. Unlit: nowhere, colours are shown as they are. Auto: Lit if the
/// picture has a ground or the sun reaches at least 0.5% of its pixels, else Headlight.
enum class Shading : std::uint8_t { Auto, Lit, Headlight, Flat, Unlit };
inline constexpr std::array kShadings = {
    Word<Shading>{Shading::Auto, "auto"},
    Word<Shading>{Shading::Lit, "lit"},
    Word<Shading>{Shading::Headlight, "headlight"},
    Word<Shading>{Shading::Flat, "flat"},
    Word<Shading>{Shading::Unlit, "unlit"},
};

/// Whether `shading` shows no shadows.
constexpr bool isWithoutSun(Shading shading) {
    return shading == Shading::Headlight || shading == Shading::Unlit;
}

/// What is seen where no surface is.
struct Background {
    enum class Kind : std::uint8_t { Color, Sky, Transparent };
    Kind kind = Kind::Sky;
    std::array<std::uint8_t, 3> color{}; // sRGB; of Kind::Color

    bool operator==(const Background&) const = default;
};

struct Look {
    Shading shading = Shading::Auto;
    double ambient = 1; // of the light of sky and ground, as a multiple of the usual
    Background background;
    bool ground = false; // the model's shadow on a plane under it is seen, and nothing else of that

    bool operator==(const Look&) const = default;
};

} // namespace gnomon::plan
