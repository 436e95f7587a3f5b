// The colours of overlays as people see them who have no green cones and as grey prints show them, and their legends;
// pictures that are shown larger than they were drawn.
#include "core/random.h"
#include "plan/color_map.h"
#include "render/overlay/bitmap_font.h"
#include "render/overlay/color_map.h"
#include "render/overlay/legend.h"
#include "render/overlay/overlay_colors.h"
#include "render/overlay/window_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace gnomon::render {
namespace {

/// Factors of two, and any two categories, must be at least this far apart in CIELAB (CIE 1976).
constexpr double kApart = 8;

double linear(double channel) {
    return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

glm::dvec3 linear(const glm::vec3& color) {
    return {linear(color.r), linear(color.g), linear(color.b)};
}

/// CIELAB of linear sRGB, white D65.
glm::dvec3 lab(const glm::dvec3& rgb) {
    const auto root = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
    const double x = root(glm::dot(rgb, glm::dvec3(0.4124, 0.3576, 0.1805)) / 0.9505);
    const double y = root(glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722)));
    const double z = root(glm::dot(rgb, glm::dvec3(0.0193, 0.1192, 0.9505)) / 1.089);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

glm::dvec3 asItIs(const glm::vec3& color) {
    return lab(linear(color));
}

/// Machado, Oliveira and Fernandes 2009, table 1: deuteranomaly of severity 1.
glm::dvec3 withoutGreenCones(const glm::vec3& color) {
    const glm::dvec3 rgb = linear(color);
    const glm::dvec3 seen = {
        glm::dot(rgb, glm::dvec3(0.367322, 0.860646, -0.227968)),
        glm::dot(rgb, glm::dvec3(0.280085, 0.672501, 0.047413)),
        glm::dot(rgb, glm::dvec3(-0.01182, 0.04294, 0.968881))};
    return lab(glm::clamp(seen, 0.0, 1.0));
}

glm::dvec3 inGrey(const glm::vec3& color) {
    return lab(glm::dvec3(glm::dot(linear(color), glm::dvec3(0.2126, 0.7152, 0.0722))));
}

using Eye = glm::dvec3 (*)(const glm::vec3&);
constexpr std::array<Eye, 3> kEyes = {&asItIs, &withoutGreenCones, &inGrey};

/// Overlays shade the heat map down to this, and the colours of categories down to kDimCategory.
constexpr float kDimHeat = 0.8F;
constexpr float kDimCategory = 0.7F;

TEST(HeatColor, PartsFactorsOfTwoForEveryEyeAndInEveryLight) {
    for (const Eye& eye : kEyes)
        for (const float light : {kDimHeat, 0.9F, 1.0F})
            for (int step = 0; step <= 500; ++step) {
                const float value = 0.25F * std::exp2(static_cast<float>(step) / 100);
                EXPECT_GE(glm::distance(eye(heatColor(value) * light), eye(heatColor(2 * value) * light)), kApart)
                    << value << " in light " << light;
            }
}

TEST(HeatColor, GrowsLighterOnBothSidesOfOneAndTurnsItsHueThere) {
    for (const Eye& eye : kEyes)
        for (int step = 0; step < 600; ++step) {
            const double x = -2 + step / 100.0;
            const glm::dvec3 here = eye(heatColor(static_cast<float>(std::exp2(x))));
            EXPECT_LT(here.x, eye(heatColor(static_cast<float>(std::exp2(x + 0.01)))).x) << std::exp2(x);
        }
    EXPECT_LT(glm::length(glm::dvec2(asItIs(heatColor(1)).y, asItIs(heatColor(1)).z)), 8) << "neutral";
    for (const Eye& eye : {&asItIs, &withoutGreenCones}) {
        EXPECT_LT(eye(heatColor(0.5F)).z, -10) << "blue where a promise is kept";
        EXPECT_GT(eye(heatColor(2)).z, 10) << "yellow where it is not";
    }
}

TEST(HeatColor, EndsAtAQuarterAndSixteen) {
    EXPECT_EQ(heatColor(0), heatColor(0.25F));
    EXPECT_EQ(heatColor(1e9F), heatColor(16));
    EXPECT_LT(glm::distance(heatColor(2), (heatColor(1) + heatColor(4)) * 0.5F), 1e-6F);
}

TEST(ColorMap, GrowsLighterEvenlyForEveryEye) {
    for (const auto& map : plan::kColorMaps)
        for (const Eye& eye : kEyes) {
            const auto lightness = [&](int step) { return eye(mapColor(map.value, static_cast<float>(step) / 100)).x; };
            const double mean = (lightness(100) - lightness(0)) / 100;
            EXPECT_GE(mean, 0.7) << map.word;
            for (int step = 0; step < 100; ++step) {
                EXPECT_GT(lightness(step + 1) - lightness(step), 0.3 * mean) << map.word << " at " << step;
                EXPECT_LT(lightness(step + 1) - lightness(step), 1.9 * mean) << map.word << " at " << step;
            }
            for (int step = 0; step + 10 <= 100; step += 10)
                EXPECT_GE(lightness(step + 10) - lightness(step), 4) << map.word << " a tenth from " << step;
        }
}

TEST(ColorMap, HoldsItsEndsAndTakesNoNumberForTheFirst) {
    for (const auto& map : plan::kColorMaps) {
        EXPECT_EQ(mapColor(map.value, -3), mapColor(map.value, 0));
        EXPECT_EQ(mapColor(map.value, 7), mapColor(map.value, 1));
        EXPECT_EQ(mapColor(map.value, std::nanf("")), mapColor(map.value, 0));
    }
    EXPECT_EQ(mapColor(plan::ColorMap::Viridis, 1), glm::vec3(0xFD, 0xE7, 0x25) / 255.0F);
}

TEST(ColorScale, HasFiguresAtRoundValuesWithinItsEnds) {
    Random random(41);
    for (int i = 0; i < 500; ++i) {
        const double min = random.uniform(-1e6, 1e6) * std::pow(10, random.uniform(-6, 3));
        const ValueScale values{plan::ColorMap::Viridis, min, min + std::pow(10, random.uniform(-3, 6))};
        const ColorScale scale = colorScale(values);
        ASSERT_GE(scale.ticks.size(), 2U) << values.min << " to " << values.max;
        ASSERT_LE(scale.ticks.size(), 7U);
        for (const ColorScale::Tick& tick : scale.ticks) {
            EXPECT_GE(tick.place, -1e-4);
            EXPECT_LE(tick.place, 1 + 1e-4);
        }
    }
    const ColorScale hours = colorScale({plan::ColorMap::Cividis, 0, 16});
    ASSERT_EQ(hours.ticks.size(), 4U);
    EXPECT_EQ(hours.ticks[0].text + " " + hours.ticks[1].text + " " + hours.ticks[3].text, "0 5 15");
    EXPECT_EQ((ValueScale{plan::ColorMap::Grey, 2, 4}.color(3)), mapColor(plan::ColorMap::Grey, 0.5F));
}

TEST(OverlayColors, PartCategoriesForEveryEye) {
    for (const Eye& eye : kEyes)
        for (const float light : {kDimCategory, 1.0F}) {
            for (int a = 0; a < kIndexColors; ++a)
                for (int b = 0; b < a; ++b)
                    EXPECT_GE(glm::distance(eye(indexColor(a) * light), eye(indexColor(b) * light)), kApart)
                        << a << " and " << b;
            for (std::size_t a = 0; a < kResidenceColors.size(); ++a)
                for (std::size_t b = 0; b < a; ++b)
                    EXPECT_GE(
                        glm::distance(eye(kResidenceColors[a] * light), eye(kResidenceColors[b] * light)), kApart);
        }
    EXPECT_EQ(indexColor(3), indexColor(3 + kIndexColors));
}

/// A plan with `count` maps, in slices one unit deep.
plan::FramePlan planOfMaps(std::size_t count) {
    plan::FramePlan plan;
    plan.splits.push_back(1);
    for (std::size_t i = 0; i < count; ++i) {
        plan.splits.push_back(static_cast<double>(i + 2));
        plan::ShadowPass pass;
        pass.map.region.slice = i;
        pass.map.rectangle.width = 640;
        pass.map.rectangle.height = 480;
        plan.passes.push_back(pass);
    }
    plan.aliasingBound = {1.5, 2.25};
    return plan;
}

TEST(Legend, SaysWhatEachOverlayShowsInLettersThatThereAre) {
    const plan::FramePlan plan = planOfMaps(2);
    for (const NamedOverlay& overlay : kOverlays) {
        const Legend legend = legendOf(overlay.value, plan);
        EXPECT_EQ(legend.title.empty(), overlay.value == Overlay::None) << overlay.word;
        std::vector<std::string> lines = legend.title;
        for (const LegendEntry& entry : legend.entries)
            lines.push_back(entry.text);
        for (const std::string& line : lines)
            for (const char c : line)
                EXPECT_TRUE(c == ' ' || hasGlyph(c)) << overlay.word << ": " << c << " of " << line;
    }
    const Legend partitions = legendOf(Overlay::Partitions, plan);
    ASSERT_EQ(partitions.entries.size(), 3);
    EXPECT_EQ(partitions.entries[1].text, "2: 2 to 3, 640x480 texels");
    EXPECT_EQ(partitions.entries[1].color, indexColor(1));
    EXPECT_TRUE(partitions.entries[2].isStriped);
    EXPECT_EQ(legendOf(Overlay::Aliasing, plan).scale->mark, (std::log2(2.25) + 2) / 6);
    EXPECT_EQ(legendOf(Overlay::Aliasing, plan::FramePlan()).scale->mark, std::nullopt);
    EXPECT_EQ(legendOf(Overlay::Partitions, planOfMaps(20)).entries.size(), kIndexColors + 1);
}

/// The colours of the entries of `legend` that are not striped.
std::vector<glm::vec3> entryColors(const Legend& legend) {
    std::vector<glm::vec3> colors;
    for (const LegendEntry& entry : legend.entries)
        if (!entry.isStriped) colors.push_back(entry.color);
    return colors;
}

void expectApart(const std::vector<glm::vec3>& colors, const Eye& eye, float light, const char* word) {
    for (std::size_t a = 0; a < colors.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_GE(glm::distance(eye(colors[a] * light), eye(colors[b] * light)), kApart) << word;
}

/// Of a bar from 1/4 to 16: factors of two are apart, and the greater is the lighter.
void expectReadable(const ColorScale& scale, const Eye& eye, float light, const char* word) {
    constexpr double kOctave = 1.0 / 6;
    for (double place = 0; place + kOctave <= 1; place += 0.01) {
        const glm::dvec3 here = eye(scale.color(static_cast<float>(place)) * light);
        const glm::dvec3 twice = eye(scale.color(static_cast<float>(place + kOctave)) * light);
        EXPECT_GE(glm::distance(here, twice), kApart) << word << " at " << place;
        EXPECT_GT(twice.x, here.x) << word << " at " << place;
    }
}

/// Whatever an overlay shows stands in its legend: each that there is, and each that will be, is looked at by every
/// eye.
TEST(Legend, OfEveryOverlayIsReadByEveryEye) {
    int scales = 0, categories = 0;
    for (const NamedOverlay& overlay : kOverlays) {
        const Legend legend = legendOf(overlay.value, planOfMaps(kIndexColors));
        scales += legend.scale ? 1 : 0;
        categories += legend.entries.size() > 1 ? 1 : 0;
        for (const Eye& eye : kEyes)
            for (const float light : {kDimHeat, 1.0F}) {
                expectApart(entryColors(legend), eye, light, overlay.word);
                if (legend.scale) expectReadable(*legend.scale, eye, light, overlay.word);
            }
    }
    EXPECT_GE(scales, 3);
    EXPECT_GE(categories, 2);
}

TEST(ColorMap, PartsValuesAFactorOfTwoApartForEveryEyeInLightAndShadow) {
    constexpr float kShadow = 0.7F; // as values are painted there
    for (const auto& map : plan::kColorMaps)
        for (const Eye& eye : kEyes)
            for (const float light : {kShadow, 1.0F})
                for (float part = 0.15F; part <= 0.5F; part += 0.005F) { // a line as even parts less below
                    const glm::dvec3 here = eye(mapColor(map.value, part) * light);
                    const glm::dvec3 twice = eye(mapColor(map.value, 2 * part) * light);
                    EXPECT_GE(glm::distance(here, twice), kApart) << map.word << " at " << part << " in " << light;
                    EXPECT_GT(twice.x, here.x) << map.word << " at " << part << " in " << light;
                }
}

TEST(ColorMap, PartsAllFactorsOfTwoOfAScaleByTheLogarithm) {
    constexpr float kShadow = 0.7F;
    for (const auto& map : plan::kColorMaps) {
        const ValueScale values{map.value, 0.003, 0.003 * kScaleSpan, true};
        for (const Eye& eye : kEyes)
            for (const float light : {kShadow, 1.0F})
                for (double value = values.min; 2 * value <= values.max; value *= 1.02) {
                    const glm::dvec3 here = eye(values.color(value) * light);
                    const glm::dvec3 twice = eye(values.color(2 * value) * light);
                    EXPECT_GE(glm::distance(here, twice), kApart) << map.word << " at " << value << " in " << light;
                    EXPECT_GT(twice.x, here.x) << map.word << " at " << value << " in " << light;
                }
        EXPECT_EQ(values.color(0), values.color(values.min / 2));
        EXPECT_EQ(values.color(-1), values.color(values.min));
    }
}

TEST(ColorScale, ByTheLogarithmHasFiguresAtRoundValuesWithinItsEnds) {
    Random random(5);
    for (int trial = 0; trial < 300; ++trial) {
        const double min = std::exp2(random.uniform(-40, 40));
        const ValueScale values{plan::ColorMap::Grey, min, min * std::exp2(random.uniform(2, 40)), true};
        const std::vector<ColorScale::Tick> ticks = colorScale(values).ticks;
        ASSERT_GE(ticks.size(), values.max > 100 * min ? 2U : 1U) << min << " to " << values.max;
        for (std::size_t i = 1; i < ticks.size(); ++i) // six dots a letter, of 192
            EXPECT_GE((ticks[i].place - ticks[i - 1].place) * 192, 3.0 * static_cast<double>(ticks[i].text.size()));
        for (const ColorScale::Tick& tick : ticks) {
            EXPECT_GE(tick.place, -1e-4);
            EXPECT_LE(tick.place, 1 + 1e-4);
            EXPECT_NEAR(std::stod(tick.text) / (min * std::pow(values.max / min, tick.place)), 1, 0.01);
        }
    }
}

TEST(Legend, IsDrawnIntoTheLowerLeftCornerAlone) {
    const Rgb grey{77, 77, 77};
    for (const NamedOverlay& overlay : kOverlays) {
        Picture picture(800, 600, grey);
        drawLegend(picture, legendOf(overlay.value, planOfMaps(4)));
        int right = 0;
        int top = 600;
        std::set<Rgb> colors;
        for (int y = 0; y < 600; ++y)
            for (int x = 0; x < 800; ++x) {
                if (picture.at(x, y) == grey) continue;
                right = std::max(right, x);
                top = std::min(top, y);
                colors.insert(picture.at(x, y));
            }
        if (overlay.value == Overlay::None) {
            EXPECT_TRUE(colors.empty());
            continue;
        }
        EXPECT_LT(right, 4 * 800 / 5) << overlay.word;
        EXPECT_GE(top, 300) << overlay.word;
        EXPECT_GE(colors.size(), 2) << overlay.word << ": ink on paper";
        if (legendOf(overlay.value, {}).scale) {
            EXPECT_GT(colors.size(), 100) << overlay.word;
        }
    }
    Picture small(100, 20, grey);
    drawLegend(small, legendOf(Overlay::Aliasing, planOfMaps(1)));
    EXPECT_TRUE(std::all_of(small.pixels.begin(), small.pixels.end(), [&](const Rgb& p) { return p == grey; }));
}

TEST(BitmapFont, LettersDifferAndStayInThePicture) {
    std::set<std::vector<Rgb>> drawn;
    int letters = 0;
    for (int c = ' ' + 1; c < 127; ++c) {
        const char letter = static_cast<char>(c);
        if (!hasGlyph(letter) || (letter >= 'A' && letter <= 'Z')) continue;
        Picture picture(kLetterDots, kLineDots);
        drawText(picture, 0, 0, 1, std::string_view(&letter, 1), {255, 255, 255});
        drawn.insert(picture.pixels);
        ++letters;
    }
    EXPECT_EQ(drawn.size(), static_cast<std::size_t>(letters));
    Picture picture(7, 7);
    drawText(picture, -4, -4, 2, "Wide", {255, 255, 255}); // ends well
    fillRectangle(picture, -100, 3, 1000, 1, {1, 2, 3});
    EXPECT_EQ(picture.at(6, 3), (Rgb{1, 2, 3}));
}

TEST(WindowPicture, HasEachPixelInAWord) {
    Random random(5);
    WindowPicture words;
    for (int round = 0; round < 40; ++round) {
        Picture picture(static_cast<int>(1 + random.below(400)), static_cast<int>(1 + random.below(400)));
        for (Rgb& pixel : picture.pixels)
            for (std::uint8_t& channel : pixel)
                channel = static_cast<std::uint8_t>(random.below(256));
        takePicture(picture, words);
        ASSERT_TRUE(words.width == picture.width && words.height == picture.height);
        ASSERT_EQ(words.pixels.size(), picture.pixels.size());
        for (std::size_t i = 0; i < words.pixels.size(); ++i) {
            const Rgb& p = picture.pixels[i];
            ASSERT_EQ(words.pixels[i], 255U * 0x1000000 + p[0] * 0x10000U + p[1] * 0x100U + p[2]);
        }
    }
}

} // namespace
} // namespace gnomon::render
