// The names of the colour maps for scalar values. render/overlay/color_map.h contains their colours.
#pragma once

#include "core/words.h"

#include <array>
#include <cstdint>

namespace gnomon::plan {

/// The colour maps, with their usual names. Lightness increases evenly along each map. Readers with colour blindness
/// (deuteranopia) and readers of a grey print therefore see values in the correct order.
enum class ColorMap : std::uint8_t { Viridis, Cividis, Grey };
inline constexpr std::array kColorMaps = {
    Word<ColorMap>{ColorMap::Viridis, "viridis"},
    Word<ColorMap>{ColorMap::Cividis, "cividis"},
    Word<ColorMap>{ColorMap::Grey, "grey"},
};

} // namespace gnomon::plan
