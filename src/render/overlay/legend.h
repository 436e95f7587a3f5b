// The legend of an overlay and its drawing into a picture.
#pragma once

#include "plan/color_map.h"
#include "render/backend.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::render {

/// A colour and its meaning.
struct LegendEntry {
    glm::vec3 color{0};
    std::string text;
    bool isStriped = false; // striped, as surfaces without a map
};

/// A bar of colours with numbers below it. Positions range from 0 at the left end to 1.
struct ColorScale {
    struct Tick {
        double place = 0;
        std::string text;
    };

    std::function<glm::vec3(float place)> color;
    std::vector<Tick> ticks;
    std::optional<double> mark; // a position with a marker
};

/// Returns the scale of heatColor, the factors from 1/4 to 16, with an optional marker at one factor.
ColorScale heatScale(std::optional<double> markedFactor = std::nullopt);

/// A mapping of values to colours from `min` to `max`. Both are finite, and min < max. A logarithmic scale also
/// requires least > 0.
struct ValueScale {
    plan::ColorMap map = plan::ColorMap::Viridis;
    double min = 0;
    double max = 1;
    bool isLogarithmic = false;

    /// Returns the position of `value` on the scale, from 0 to 1 within the range. Returns a negative position if the
    /// value has no logarithm.
    float place(double value) const;

    glm::vec3 color(double value) const;
};

/// Usual ratio of most to least on a logarithmic scale. At this ratio, each factor of two remains distinguishable in
/// all colour maps.
inline constexpr double kScaleSpan = 64;

/// Returns the colour bar of `values`, with ticks at round numbers.
ColorScale colorScale(const ValueScale& values);

/// The legend of one picture.
struct Legend {
    std::vector<std::string> title; // one entry per line
    std::optional<ColorScale> scale;
    std::vector<LegendEntry> entries;
};

/// Returns the legend of `overlay` for a frame of `plan`, or an empty legend for Overlay::None. Depths are along the
/// view, in the model's units.
Legend legendOf(Overlay overlay, const plan::FramePlan& plan);

/// Draws `legend` into the lower left corner, with two pixels or one pixel per dot, as it fits. Does nothing if the
/// legend is empty or the picture is too small.
void drawLegend(Picture& picture, const Legend& legend);

} // namespace gnomon::render
