// Colours that tell a value of the surface: which one, in which map, between which ends.
#pragma once

#include "plan/color_map.h"
#include "settings/codec.h"

#include <array>
#include <optional>

namespace gnomon::settings {

/// Height along what is up, in the source's coordinates and unit; slope in degrees, 0 level and 90 upright.
enum class ColorBy : std::uint8_t { None, Height, Slope };
inline constexpr std::array kColorBys = {
    Word<ColorBy>{ColorBy::None, "none"},
    Word<ColorBy>{ColorBy::Height, "height"},
    Word<ColorBy>{ColorBy::Slope, "slope"},
};

struct ValueColors {
    ColorBy by = ColorBy::None;
    plan::ColorMap map = plan::ColorMap::Viridis;
    std::optional<std::array<double, 2>> range; // values of the map's ends; nothing: all that there can be
};

/// "LO,HI", the first less than the second.
Codec<std::array<double, 2>> valueRange();

} // namespace gnomon::settings
