#include "settings/look_settings.h"

#include "settings/setting_place.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

namespace gnomon::settings {

namespace {

using plan::Background;
using Color = std::array<std::uint8_t, 3>;

constexpr double kMaxAmbient = 10;

struct NamedBackground {
    Background value;
    const char* word = "";
};

constexpr std::array kBackgrounds = {
    NamedBackground{{Background::Kind::Sky, {}}, "sky"},
    NamedBackground{{Background::Kind::Color, {255, 255, 255}}, "white"},
    NamedBackground{{Background::Kind::Transparent, {}}, "transparent"},
};

std::optional<Color> colorOf(const std::string& text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    Color color{};
    for (std::size_t c = 0; c < color.size(); ++c)
        for (const char digit : {text[1 + 2 * c], text[2 + 2 * c]}) {
            constexpr std::string_view kDigits = "0123456789abcdef0123456789ABCDEF";
            const std::size_t place = kDigits.find(digit);
            if (place == std::string_view::npos) return std::nullopt;
            color[c] = static_cast<std::uint8_t>(std::size_t{color[c]} * 16 + place % 16);
        }
    return color;
}

} // namespace

Codec<Background> background() {
    return {
        [](const std::string& text) -> std::optional<Background> {
            if (const auto named = valueOf(kBackgrounds, text)) return named;
            if (const auto color = colorOf(text)) return Background{Background::Kind::Color, *color};
            return std::nullopt;
        },
        [](const Background& value) -> std::string {
            if (const std::string_view word = wordOf(kBackgrounds, value); !word.empty()) return std::string(word);
            std::array<char, 8> text{};
            std::snprintf(text.data(), text.size(), "#%02x%02x%02x", value.color[0], value.color[1], value.color[2]);
            return text.data();
        },
        enumerated(kBackgrounds, ", ", ", ") + " or a colour such as #336699"};
}

Codec<std::vector<Section>> sections() {
    return {
        [](const std::string& text) -> std::optional<std::vector<Section>> {
            std::vector<Section> all;
            std::istringstream parts(text);
            for (std::string part; std::getline(parts, part, ';');) {
                const auto comma = [&](std::size_t from) { return part.find(',', from); };
                const std::size_t third = comma(comma(comma(0) + 1) + 1);
                if (std::count(part.begin(), part.end(), ',') != 5) return std::nullopt;
                const auto point = vector().read(part.substr(0, third));
                const auto normal = direction().read(part.substr(third + 1));
                if (!point || !normal || all.size() == kMaxSections) return std::nullopt;
                all.push_back({*point, *normal});
            }
            return all.empty() ? std::nullopt : std::optional(all);
        },
        [](const std::vector<Section>& all) {
            std::string text;
            for (const Section& section : all)
                text +=
                    (text.empty() ? "" : ";") + vector().write(section.point) + "," + vector().write(section.normal);
            return text;
        },
        "PX,PY,PZ,NX,NY,NZ, a point and a direction of a length above 0, at most six times"};
}

std::vector<Setting> lookSettings() {
    return {
        plain(
            &Settings::projection,
            {.name = "projection",
             .form = "KIND",
             .help = "Projection: " + enumerated(kProjections, ", ", " or "),
             .usually = "from the camera file or path, else perspective"},
            ifGiven(oneOf(kProjections))),
        look(
            &plan::ShadingSettings::shading,
            {.name = "shading",
             .form = "MODE",
             .help = "Shading: auto, lit (sun), headlight, flat or unlit",
             .offer = {.title = "shading"}},
            oneOf(plan::kShadings)),
        look(
            &plan::ShadingSettings::ambient,
            {.name = "ambient",
             .form = "F",
             .help = "Factor for the light of sky and ground, from 0 to 10",
             .offer = {.title = "ambient light", .min = 0.25, .max = 4}},
            number(
                "a number from 0 to " + shortest(kMaxAmbient),
                [](double value) { return value >= 0 && value <= kMaxAmbient; })),
        look(
            &plan::ShadingSettings::background,
            {.name = "background",
             .form = "COLOUR|sky|white|transparent",
             .help = "Colour such as #336699, sky, white or transparent"},
            background()),
        look(
            &plan::ShadingSettings::ground,
            {.name = "ground",
             .form = {},
             .help = "Shadow of the model on a plane under it",
             .offer = {.title = "shadow on the ground"}},
            onOff()),
        plain(
            &Settings::sections,
            {.name = "section",
             .form = "PX,PY,PZ,NX,NY,NZ",
             .help = "Plane (point and normal) that cuts away the side of its normal; up to six times (software "
                     "backend)",
             .isRepeated = true},
            sections()),
        plain(
            &Settings::sectionCasters,
            {.name = "section-casters",
             .form = {},
             .help = "Geometry that --section cuts away casts no shadow (cut) or its shadow (keep)",
             .offer = {.title = "casters of sections"}},
            oneOf(kSectionCasters)),
    };
}

} // namespace gnomon::settings
