// The options for pictures whose colours show a value of the surface: the value, the colour map and its range.
#pragma once

#include "plan/color_map.h"
#include "settings/codec.h"

#include <array>
#include <optional>
#include <string>

namespace gnomon::settings {

/// The value that the colours show:
/// - Vertex: the stored colours of the vertices, without a colour map.
/// - Height: along the up direction, in the coordinates and the unit of the source.
/// - Slope: in degrees, 0 for level and 90 for vertical surfaces.
/// - Error: the stored error of the drawn cluster, in the unit of the source.
/// - Field: a field that the model stores for its vertices.
enum class ColorBy : std::uint8_t { None, Vertex, Height, Slope, Error, Field };
inline constexpr std::array kColorBys = {
    Word<ColorBy>{ColorBy::None, "none"},
    Word<ColorBy>{ColorBy::Vertex, "vertex"},
    Word<ColorBy>{ColorBy::Height, "height"},
    Word<ColorBy>{ColorBy::Slope, "slope"},
    Word<ColorBy>{ColorBy::Error, "error"},
};

/// How the colours of a picture show a value of the surface: the value, the colour map, and the values at the ends of
/// the map.
struct ValueColors {
    ColorBy by = ColorBy::None;
    std::string field{}; // name of the field, for ColorBy::Field
    plan::ColorMap map = plan::ColorMap::Viridis;
    std::optional<std::array<double, 2>>
        range{}; // values at the ends of the map; nullopt: the range of the value (inspect/value_picture.h)

    bool operator==(const ValueColors&) const = default;
};

/// The values of --color-by, --colormap and --color-range as the user typed them. A text is empty if the option is not
/// given.
struct ValueColorWords {
    std::string by;
    std::string map;
    std::string range;
};

/// Converts the values of --color-by, --colormap and --color-range. A name that is not in kColorBys is the name of a
/// field. Throws UsageError for an invalid map or range, and for a range with a value that has no colour map.
ValueColors valueColors(const ValueColorWords& words);

/// Returns true if `by` is a value that vertices or clusters store. Only backends with the capability `seesTriangles`
/// can show it.
constexpr bool isOfTriangles(ColorBy by) {
    return by == ColorBy::Vertex || by == ColorBy::Error || by == ColorBy::Field;
}

/// Returns the value of `--color-by` for `colors`: a word such as "height", or the name of a field in printable
/// characters.
std::string nameOf(const ValueColors& colors);

/// Returns the text codec for a range "LO,HI" with LO below HI.
Codec<std::array<double, 2>> valueRange();

} // namespace gnomon::settings
