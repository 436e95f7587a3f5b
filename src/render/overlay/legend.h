// The legend of an overlay: explains its colours in a corner of the picture.
#pragma once

#include "plan/color_map.h"
#include "render/backend.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::render {

/// A colour of an overlay and its meaning, as one entry of the legend.
struct LegendEntry {
    glm::vec3 color{0};
    std::string text;
    bool isStriped = false; // true: drawn with stripes, like surfaces without a map
};

/// A colour bar of a legend, with numbers below the bar. Positions on the bar range from 0 at the left end to 1 at the
/// right end.
struct ColorScale {
    struct Tick {
        double place = 0;
        std::string text;
    };

    std::function<glm::vec3(float place)> color;
    std::vector<Tick> ticks;
    std::optional<double> mark; // position of a marker on the bar
};

/// Returns the colour bar for factors from 1/4 to 16, with the colours of heatColor. If `markedFactor` is given, the
/// bar has a marker at this factor.
ColorScale heatScale(std::optional<double> markedFactor = std::nullopt);

/// A colour scale for values from `min` to `max`. Both ends are finite, and min < max. A logarithmic scale also
/// requires min > 0.
struct ValueScale {
    plan::ColorMap map = plan::ColorMap::Viridis;
    double min = 0;
    double max = 1;
    bool isLogarithmic = false;

    /// Returns the position of `value` on the colour scale, from 0 at `min` to 1 at `max`. Returns a negative position
    /// if the scale is logarithmic and the value has no logarithm.
    float place(double value) const;

    glm::vec3 color(double value) const;
};

/// Usual ratio max / min of a logarithmic colour scale. With this ratio, values that differ by a factor of two have
/// distinguishable colours in all colour maps.
inline constexpr double kScaleSpan = 64;

/// Returns the colour bar of the scale `values`, with ticks at round numbers.
ColorScale colorScale(const ValueScale& values);

/// The legend of one picture: title, colour bar and entries.
struct Legend {
    std::vector<std::string> title; // one entry per line
    std::optional<ColorScale> scale;
    std::vector<LegendEntry> entries;
};

/// Returns the legend that explains `overlay` in a frame of `plan`, or an empty legend for Overlay::None. View depths
/// in the legend are in the units of the model.
Legend legendOf(Overlay overlay, const plan::FramePlan& plan);

/// Draws `legend` into the lower left corner of `picture`. A dot of the font has two pixels, or one pixel in a small
/// picture. If the legend is empty or the picture is too small, the function does nothing.
void drawLegend(Picture& picture, const Legend& legend);

} // namespace gnomon::render
