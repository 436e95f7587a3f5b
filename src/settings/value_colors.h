// Colours that tell a value of the surface: which one, in which map, between which ends.
#pragma once

#include "plan/color_map.h"
#include "settings/codec.h"

#include <array>
#include <optional>
#include <string>

namespace gnomon::settings {

/// Vertex: the stored colours themselves. Height along what is up, in the source's coordinates and unit; slope in
/// degrees, 0 level and 90 upright; the stored error of the cluster that is drawn, the source's unit; a field that the
/// model keeps of its vertices.
enum class ColorBy : std::uint8_t { None, Vertex, Height, Slope, Error, Field };
inline constexpr std::array kColorBys = {
    Word<ColorBy>{ColorBy::None, "none"},
    Word<ColorBy>{ColorBy::Vertex, "vertex"},
    Word<ColorBy>{ColorBy::Height, "height"},
    Word<ColorBy>{ColorBy::Slope, "slope"},
    Word<ColorBy>{ColorBy::Error, "error"},
};

struct ValueColors {
    ColorBy by = ColorBy::None;
    std::string field{}; // its name, with ColorBy::Field
    plan::ColorMap map = plan::ColorMap::Viridis;
    std::optional<std::array<double, 2>> range{}; // values of the map's ends; nothing: all that there can be

    bool operator==(const ValueColors&) const = default;
};

/// How a person asks for them: the text of each option, empty where it is not given.
struct ValueColorWords {
    std::string by;
    std::string map;
    std::string range;
};

/// What is asked for; a name that is none of the words above is that of a field. Throws UsageError.
ValueColors valueColors(const ValueColorWords& words);

/// Returns whether `by` is a value of vertices or clusters. Backends with the capability `seesTriangles` can show it.
constexpr bool isOfTriangles(ColorBy by) {
    return by == ColorBy::Vertex || by == ColorBy::Error || by == ColorBy::Field;
}

/// Returns the word of `--color-by`: "height", or the name of a field with printable characters only.
std::string nameOf(const ValueColors& colors);

/// "LO,HI", the first less than the second.
Codec<std::array<double, 2>> valueRange();

} // namespace gnomon::settings
