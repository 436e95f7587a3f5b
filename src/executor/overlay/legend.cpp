#include "executor/overlay/legend.h"

#include "core/formatted.h"
#include "executor/overlay/bitmap_font.h"
#include "executor/overlay/overlay_colors.h"

#include <algorithm>
#include <cmath>

namespace gnomon::executor {

namespace {

constexpr Rgb kPaper = {20, 24, 30};
constexpr Rgb kInk = {240, 240, 240};
constexpr int kMargin = 5; // all in dots
constexpr int kSwatch = 12;
constexpr int kBarWidth = 192;
constexpr int kBarHeight = 8;
constexpr double kLowest = -2; // logarithms to base 2 of the scale's ends
constexpr double kHighest = 4;

Rgb bytes(const glm::vec3& color) {
    const glm::vec3 scaled = color * 255.0F + 0.5F;
    return {
        static_cast<std::uint8_t>(scaled.r), static_cast<std::uint8_t>(scaled.g), static_cast<std::uint8_t>(scaled.b)};
}

/// A map a line, up to as many as there are colours.
void addMaps(const plan::FramePlan& plan, Legend& legend) {
    for (std::size_t i = 0; i < plan.passes.size() && i < kIndexColors; ++i) {
        const shadow::ShadowMap& map = plan.passes[i].map;
        std::string line = formatted("%zu: ", i + 1);
        if (map.region.face != shadow::Face::Whole) line += std::string(shadow::name(map.region.face)) + ", ";
        if (map.region.slice + 1 < plan.splits.size())
            line += formatted("%.3g to %.3g, ", plan.splits[map.region.slice], plan.splits[map.region.slice + 1]);
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
    if (legend.hasHeatScale) width = std::max(width, kBarWidth);
    for (const LegendEntry& entry : legend.entries)
        width = std::max(width, kSwatch + kMargin + static_cast<int>(entry.text.size()) * kLetterDots);
    const std::size_t lines = legend.title.size() + legend.entries.size();
    const int scale = legend.hasHeatScale ? kBarHeight + kLineDots + kMargin : 0;
    return {width + 2 * kMargin, static_cast<int>(lines) * kLineDots + scale + 2 * kMargin};
}

/// Draws in dots, from the legend's upper left corner.
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

/// Where `value` lies on the scale, in dots from its left end.
int barPlace(double value) {
    const double part = (std::log2(value) - kLowest) / (kHighest - kLowest);
    return static_cast<int>(std::lround(std::clamp(part, 0.0, 1.0) * (kBarWidth - 1)));
}

void drawScale(const Pen& pen, int y, const std::optional<double>& mark) {
    for (int x = 0; x < kBarWidth; ++x) {
        const double exponent = kLowest + (kHighest - kLowest) * x / (kBarWidth - 1);
        pen.fill(kMargin + x, y, 1, kBarHeight, bytes(heatColor(static_cast<float>(std::exp2(exponent)))));
    }
    for (const double value : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
        const std::string figure = value < 1 ? formatted("1/%g", 1 / value) : formatted("%g", value);
        const int width = static_cast<int>(figure.size()) * kLetterDots - 1;
        const int left = std::clamp(barPlace(value) - width / 2, 0, kBarWidth - width);
        pen.write(kMargin + left, y + kBarHeight + 3, figure);
        pen.fill(kMargin + barPlace(value), y + kBarHeight, 1, 2, kInk);
    }
    if (mark) {
        pen.fill(kMargin + barPlace(*mark) - 1, y - 2, 3, kBarHeight + 4, kPaper);
        pen.fill(kMargin + barPlace(*mark), y - 2, 1, kBarHeight + 4, kInk);
    }
}

void drawSwatch(const Pen& pen, int y, const LegendEntry& entry) {
    if (!entry.isStriped) return pen.fill(kMargin, y, kSwatch, kLineDots - 3, bytes(entry.color));
    for (int row = 0; row < kLineDots - 3; ++row)
        for (int x = 0; x < kSwatch; ++x)
            pen.fill(kMargin + x, y + row, 1, 1, bytes(entry.color * kWithoutMap[(x + row) / 4 % 2 == 0 ? 0 : 1]));
}

} // namespace

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
        legend.hasHeatScale = true;
        if (!plan.passes.empty()) {
            legend.mark = plan.promised.worst();
            legend.title.push_back(formatted("mark: promised at most %.3g", *legend.mark));
        }
        addWithoutMap(legend);
        break;
    case Overlay::Lod:
        legend.title = {
            "level of detail: error on the screen",
            formatted("1 on the scale: the threshold, %.3g pixels", plan.quality.errorPixels)};
        legend.hasHeatScale = true;
        break;
    case Overlay::Clusters:
        legend.title = {
            "clusters: patches of triangles that are", "drawn or left as one; colours only", "part neighbours"};
        break;
    case Overlay::Projection:
        legend.title = {"projection aliasing: cosine to the eye", "over cosine to the light"};
        legend.hasHeatScale = true;
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
    if (legend.hasHeatScale) {
        drawScale(pen, y + 1, legend.mark);
        y += kBarHeight + kLineDots + kMargin;
    }
    for (const LegendEntry& entry : legend.entries) {
        drawSwatch(pen, y, entry);
        pen.write(kMargin + kSwatch + kMargin, y, entry.text);
        y += kLineDots;
    }
}

} // namespace gnomon::executor
