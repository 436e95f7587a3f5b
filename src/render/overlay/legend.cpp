#include "render/overlay/legend.h"

#include "core/formatted.h"
#include "render/overlay/bitmap_font.h"
#include "render/overlay/color_map.h"
#include "render/overlay/overlay_colors.h"

#include <algorithm>
#include <cmath>

namespace gnomon::render {

namespace {

constexpr Rgb kPaper = {20, 24, 30};
constexpr Rgb kInk = {240, 240, 240};
constexpr int kMargin = 5; // all sizes are in dots
constexpr int kSwatch = 12;
constexpr int kBarWidth = 192;
constexpr int kBarHeight = 8;
constexpr double kLowest = -2; // log2 of the smallest factor on the scale
constexpr double kHighest = 4;

Rgb bytes(const glm::vec3& color) {
    const glm::vec3 scaled = color * 255.0F + 0.5F;
    return {
        static_cast<std::uint8_t>(scaled.r), static_cast<std::uint8_t>(scaled.g), static_cast<std::uint8_t>(scaled.b)};
}

/// Adds one legend entry per shadow map of `plan`, up to the number of different colours.
void addMaps(const plan::FramePlan& plan, Legend& legend) {
    for (std::size_t i = 0; i < plan.passes.size() && i < kIndexColors; ++i) {
        const shadow::ShadowMap& map = plan.passes[i].map;
        std::string line = formatted("%zu: ", i + 1);
        if (map.region.face != shadow::Face::Whole) line += std::string(shadow::name(map.region.face)) + ", ";
        if (map.region.slice + 1 < plan.splits.size())
            line += formatted(
                "%.3g to %.3g, ",
                depthFromAskedEye(plan, plan.splits[map.region.slice]),
                depthFromAskedEye(plan, plan.splits[map.region.slice + 1]));
        legend.entries.push_back(
            {indexColor(static_cast<int>(i)),
             line + formatted("%dx%d texels", map.rectangle.width, map.rectangle.height),
             false});
    }
    if (plan.passes.size() > kIndexColors)
        legend.title.push_back(formatted("%zu maps; colours repeat after %d", plan.passes.size(), kIndexColors));
}

void addWithoutMap(Legend& legend) {
    legend.entries.push_back({glm::vec3(1), "no map: turned from the light", true});
}

struct Size {
    int width = 0;
    int height = 0;
};

Size sizeInDots(const Legend& legend) {
    std::size_t letters = 0;
    for (const std::string& line : legend.title)
        letters = std::max(letters, line.size());
    int width = static_cast<int>(letters) * kLetterDots;
    if (legend.scale) width = std::max(width, kBarWidth);
    for (const LegendEntry& entry : legend.entries)
        width = std::max(width, kSwatch + kMargin + static_cast<int>(entry.text.size()) * kLetterDots);
    const std::size_t lines = legend.title.size() + legend.entries.size();
    const int scale = legend.scale ? kBarHeight + kLineDots + kMargin : 0;
    return {width + 2 * kMargin, static_cast<int>(lines) * kLineDots + scale + 2 * kMargin};
}

/// Draws the legend into a picture, with positions in dots. The origin is the upper left corner of the legend.
class Pen {
public:
    Pen(Picture& picture, int top, int dot) : picture_(&picture), top_(top), dot_(dot) {}

    void fill(int x, int y, int width, int height, const Rgb& color) const {
        fillRectangle(*picture_, x * dot_, top_ + y * dot_, width * dot_, height * dot_, color);
    }

    void write(int x, int y, const std::string& words) const {
        drawText(*picture_, x * dot_, top_ + y * dot_, dot_, words, kInk);
    }

private:
    Picture* picture_;
    int top_;
    int dot_;
};

/// Converts a position on the colour bar, in [0, 1], to dots from the left end of the bar.
int barPlace(double place) {
    return static_cast<int>(std::lround(std::clamp(place, 0.0, 1.0) * (kBarWidth - 1)));
}

void drawScale(const Pen& pen, int y, const ColorScale& scale) {
    for (int x = 0; x < kBarWidth; ++x)
        pen.fill(kMargin + x, y, 1, kBarHeight, bytes(scale.color(static_cast<float>(x) / (kBarWidth - 1))));
    for (const ColorScale::Tick& tick : scale.ticks) {
        const int width = static_cast<int>(tick.text.size()) * kLetterDots - 1;
        const int left = std::clamp(barPlace(tick.place) - width / 2, 0, std::max(kBarWidth - width, 0));
        pen.write(kMargin + left, y + kBarHeight + 3, tick.text);
        pen.fill(kMargin + barPlace(tick.place), y + kBarHeight, 1, 2, kInk);
    }
    if (scale.mark) {
        pen.fill(kMargin + barPlace(*scale.mark) - 1, y - 2, 3, kBarHeight + 4, kPaper);
        pen.fill(kMargin + barPlace(*scale.mark), y - 2, 1, kBarHeight + 4, kInk);
    }
}

void drawSwatch(const Pen& pen, int y, const LegendEntry& entry) {
    if (!entry.isStriped) return pen.fill(kMargin, y, kSwatch, kLineDots - 3, bytes(entry.color));
    for (int row = 0; row < kLineDots - 3; ++row)
        for (int x = 0; x < kSwatch; ++x)
            pen.fill(kMargin + x, y + row, 1, 1, bytes(entry.color * kWithoutMap[(x + row) / 4 % 2 == 0 ? 0 : 1]));
}

/// Returns the smallest step of the form 1, 2 or 5 times a power of ten that divides `span` into at most `max` steps.
double roundStep(double span, int max) {
    const double min = span / max;
    const double power = std::pow(10.0, std::floor(std::log10(min)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= min * (1 - 1e-9)) return factor * power;
    return 10 * power;
}

} // namespace

ColorScale heatScale(std::optional<double> markedFactor) {
    const auto place = [](double factor) { return (std::log2(factor) - kLowest) / (kHighest - kLowest); };
    ColorScale scale;
    scale.color = [](float at) {
        return heatColor(static_cast<float>(std::exp2(kLowest + (kHighest - kLowest) * double{at})));
    };
    for (const double factor : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0})
        scale.ticks.push_back({place(factor), factor < 1 ? formatted("1/%g", 1 / factor) : formatted("%g", factor)});
    if (markedFactor) scale.mark = place(*markedFactor);
    return scale;
}

float ValueScale::place(double value) const {
    if (!isLogarithmic) return static_cast<float>((value - min) / (max - min));
    return value > 0 ? static_cast<float>(std::log2(value / min) / std::log2(max / min)) : -1;
}

glm::vec3 ValueScale::color(double value) const {
    return mapColor(map, place(value));
}

namespace {

/// Returns true if the numbers below a colour bar do not overlap.
bool areClear(const std::vector<ColorScale::Tick>& ticks) {
    const auto reach = [](const ColorScale::Tick& tick) {
        return 0.5 * static_cast<double>(kLetterDots) * static_cast<double>(tick.text.size() + 1);
    };
    for (std::size_t i = 1; i < ticks.size(); ++i)
        if ((ticks[i].place - ticks[i - 1].place) * kBarWidth < reach(ticks[i]) + reach(ticks[i - 1])) return false;
    return true;
}

/// Returns ticks of a logarithmic colour bar at 1, 2 and 5 times powers of ten. If their numbers would overlap, returns
/// fewer ticks.
std::vector<ColorScale::Tick> logarithmicTicks(const ValueScale& values) {
    const int first = static_cast<int>(std::floor(std::log10(values.min)));
    const int last = static_cast<int>(std::ceil(std::log10(values.max)));
    std::vector<ColorScale::Tick> ticks;
    const auto place = [&](const std::vector<int>& digits, int stride) {
        ticks.clear();
        for (int exponent = first; exponent <= last; exponent += stride)
            for (const int digit : digits) {
                const double value = digit * std::pow(10.0, exponent);
                const float at = values.place(value);
                if (at >= -1e-6F && at <= 1 + 1e-6F) ticks.push_back({double{at}, formatted("%.3g", value)});
            }
        return areClear(ticks);
    };
    if (place({1, 2, 5}, 1) || place({1, 3}, 1)) return ticks;
    for (int stride = 1; !place({1}, stride); ++stride) {
    }
    return ticks;
}

} // namespace

ColorScale colorScale(const ValueScale& values) {
    ColorScale scale;
    scale.color = [map = values.map](float at) { return mapColor(map, at); };
    if (values.isLogarithmic) {
        scale.ticks = logarithmicTicks(values);
        return scale;
    }
    constexpr int kMaxSteps = 6;
    const double step = roundStep(values.max - values.min, kMaxSteps);
    const double first = std::ceil(values.min / step - 1e-6);
    for (int i = 0; i <= kMaxSteps && (first + i) * step <= values.max + 1e-6 * step; ++i)
        scale.ticks.push_back(
            // Adding 0.0 removes the minus sign of -0.
            {double{values.place((first + i) * step)}, formatted("%.7g", (first + i) * step + 0.0)});
    return scale;
}

Legend legendOf(Overlay overlay, const plan::FramePlan& plan) {
    Legend legend;
    switch (overlay) {
    case Overlay::None:
        break;
    case Overlay::Partitions:
        legend.title = {"partitions: a shadow map a colour,", "by depth along the view in model units"};
        addMaps(plan, legend);
        addWithoutMap(legend);
        break;
    case Overlay::Texels:
        legend.title = {"shadow texels: a cell is 5x5 texels,", "tinted by its map"};
        addMaps(plan, legend);
        break;
    case Overlay::Aliasing:
        legend.title = {"perspective aliasing:", "pixels across a shadow texel"};
        legend.scale = heatScale();
        if (!plan.passes.empty()) {
            legend.scale = heatScale(plan.aliasingBound.worst());
            legend.title.push_back(formatted("mark: aliasing bound %.3g", plan.aliasingBound.worst()));
        }
        addWithoutMap(legend);
        break;
    case Overlay::Lod:
        legend.title = {
            "level of detail: error on the screen",
            formatted("1 on the scale: the threshold, %.3g pixels", plan.quality.errorPixels)};
        legend.scale = heatScale();
        break;
    case Overlay::Clusters:
        legend.title = {
            "clusters: patches of triangles that are", "drawn or left as one; colours only", "part neighbours"};
        break;
    case Overlay::Projection:
        legend.title = {"projection aliasing: cosine to the eye", "over cosine to the light"};
        legend.scale = heatScale();
        addWithoutMap(legend);
        break;
    case Overlay::Residency:
        legend.title = {"residency: what memory holds"};
        legend.entries = {
            {kResidenceColors[0], "as fine as asked for", false},
            {kResidenceColors[1], "waits for finer pages", false},
            {kResidenceColors[2], "finer pages are damaged", false}};
        break;
    }
    return legend;
}

void drawLegend(Picture& picture, const Legend& legend) {
    if (legend.title.empty()) return;
    const Size size = sizeInDots(legend);
    int dot = 2;
    while (dot > 0 && (size.width * dot > 4 * picture.width / 5 || size.height * dot > picture.height / 2))
        --dot;
    if (dot == 0) return;
    const Pen pen(picture, picture.height - size.height * dot, dot);
    pen.fill(0, 0, size.width, size.height, kPaper);
    int y = kMargin;
    for (const std::string& line : legend.title) {
        pen.write(kMargin, y, line);
        y += kLineDots;
    }
    if (legend.scale) {
        drawScale(pen, y + 1, *legend.scale);
        y += kBarHeight + kLineDots + kMargin;
    }
    for (const LegendEntry& entry : legend.entries) {
        drawSwatch(pen, y, entry);
        pen.write(kMargin + kSwatch + kMargin, y, entry.text);
        y += kLineDots;
    }
}

} // namespace gnomon::render
