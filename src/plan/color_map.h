// The colour maps that values along a line are shown in; what their colours are executor/overlay/color_map.h says.
#pragma once

#include "core/words.h"

#include <array>
#include <cstdint>

namespace gnomon::plan {

/// By the names that they have elsewhere. Lightness grows along each of them, evenly, so that they are read alike by
/// eyes without green cones and in a grey print.
enum class ColorMap : std::uint8_t { Viridis, Cividis, Grey };
inline constexpr std::array kColorMaps = {
    Word<ColorMap>{ColorMap::Viridis, "viridis"},
    Word<ColorMap>{ColorMap::Cividis, "cividis"},
    Word<ColorMap>{ColorMap::Grey, "grey"},
};

} // namespace gnomon::plan
