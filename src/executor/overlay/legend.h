// What the colours of an overlay mean, and its drawing into a picture.
#pragma once

#include "executor/executor.h"
#include "plan/color_map.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::executor {

/// A colour and what it stands for.
struct LegendEntry {
    glm::vec3 color{0};
    std::string text;
    bool isStriped = false; // as what has no map is painted
};

/// A bar of colours with figures below it; places along it go from 0, its left end, to 1.
struct ColorScale {
    struct Tick {
        double place = 0;
        std::string text;
    };

    std::function<glm::vec3(float place)> color;
    std::vector<Tick> ticks;
    std::optional<double> mark; // a place that is pointed at
};

/// The scale of heatColor, the factors from 1/4 to 16, with a mark at one of them.
ColorScale heatScale(std::optional<double> markedFactor = std::nullopt);

/// What values are shown in: colours from `least` to `most`, both finite and the first less; where they go by the
/// logarithm it is above 0.
struct ValueScale {
    plan::ColorMap map = plan::ColorMap::Viridis;
    double least = 0;
    double most = 1;
    bool isLogarithmic = false;

    /// Where `value` lies between them, 0 to 1 within; below 0 where it has no logarithm.
    float place(double value) const;

    glm::vec3 color(double value) const;
};

/// What a scale that goes by the logarithm usually spans: by its maps each eye parts each of its factors of two.
inline constexpr double kScaleSpan = 64;

/// The scale of `values`, with figures at round values.
ColorScale colorScale(const ValueScale& values);

/// The legend of one picture.
struct Legend {
    std::vector<std::string> title; // lines
    std::optional<ColorScale> scale;
    std::vector<LegendEntry> entries;
};

/// What `overlay` shows of a frame of `plan`; nothing for Overlay::None. Depths are in the model's units, along the
/// view.
Legend legendOf(Overlay overlay, const plan::FramePlan& plan);

/// Draws `legend` into the lower left corner, in letters of two or of one pixel a dot as they fit. Pictures too small
/// for it stay as they are, and any for an empty one.
void drawLegend(Picture& picture, const Legend& legend);

} // namespace gnomon::executor
