#include "settings/table.h"

#include "core/check.h"
#include "settings/limits.h"
#include "settings/look_settings.h"
#include "settings/setting_place.h"
#include "settings/sun_settings.h"

#include <algorithm>

namespace gnomon::settings {

namespace {

using plan::Quality;
using Size = std::array<int, 2>;

Codec<Size> imageSize() {
    return size("sides of at most " + std::to_string(kMaxSide) + " pixels", [](const Size& value) {
        return std::max(value[0], value[1]) <= kMaxSide;
    });
}

Codec<Size> textureSize() {
    return size("at most 16384x16384 texels, the largest texture", [](const Size& value) {
        return std::int64_t{value[0]} * value[1] <= kMaxShadowTexels;
    });
}

/// Returns the text codec for a distance or the word "auto", whose value is 0.
Codec<double> distanceOrZero() {
    const Codec<std::optional<double>> codec = orAuto(distance());
    return {
        [codec](const std::string& text) -> std::optional<double> {
            const auto value = codec.read(text);
            return value ? std::optional(value->value_or(0)) : std::nullopt;
        },
        [codec](double value) { return codec.write(value > 0 ? std::optional(value) : std::nullopt); },
        codec.expected};
}

/// Returns the settings for the image size and the camera.
std::vector<Setting> cameraSettings() {
    return {
        plain(
            &Settings::imageSize,
            {.name = "size",
             .form = "WxH",
             .help = "Size of the picture in pixels",
             .statedAs = "image_size",
             .limit = Limit::ImageSize},
            imageSize()),
        plain(
            &Settings::cameraFile,
            {.name = "camera", .form = "FILE.json", .help = "Camera file; the key I of the window writes one"},
            text()),
        plain(
            &Settings::eye,
            {.name = "eye", .form = "x,y,z", .help = "Position of the camera", .usually = "the whole model is in view"},
            ifGiven(vector())),
        plain(
            &Settings::target,
            {.name = "target",
             .form = "x,y,z",
             .help = "Point that the camera looks at",
             .usually = "the centre of the model"},
            ifGiven(vector())),
        plain(
            &Settings::up,
            {.name = "up",
             .form = "AXIS",
             .help = "Up direction: x, y, z, -x, -y, -z, a vector X,Y,Z, or auto (an estimate from the shape)",
             .usually = "as stored in the model"},
            ifGiven(upDirection())),
        plain(
            &Settings::side,
            {.name = "view", .form = "SIDE", .help = "View from the " + enumerated(path::kViewSides, ", ", " or ")},
            ifGiven(oneOf(path::kViewSides))),
        plain(
            &Settings::fovYDegrees,
            {.name = "fov-y",
             .form = "DEG",
             .help = "Full vertical angle of view in degrees",
             .usually = "60",
             .limit = Limit::FieldOfView},
            ifGiven(number("an angle above 0 and below 180 degrees", [](double v) { return v > 0 && v < 180; }))),
    };
}

Setting lightSetting() {
    return {
        {.name = "light",
         .form = "x,y,z",
         .help = "Direction to the light",
         .usually = "0.4,1,0.3 if y is up",
         .statedAs = "light",
         .limit = Limit::LightDirection},
        direction(),
        [](const Settings& settings) { return settings.towardsLight; },
        [](Settings& settings, const glm::dvec3& value) {
            settings.towardsLight = value;
            settings.isLightGiven = true;
        }};
}

/// Returns the settings for the depth range in which shadow resolution is guaranteed, the directional light, and the
/// max number of triangles.
std::vector<Setting> sceneSettings() {
    return {
        quality(
            &Quality::near,
            {.name = "shadow-near",
             .form = "D|auto",
             .help = "Start of the depth range with guaranteed shadow resolution, in units of the model; it clips "
                     "nothing",
             .statedAs = "near_and_far",
             .limit = Limit::NearDepth},
            orAuto(distance())),
        quality(
            &Quality::far,
            {.name = "shadow-far",
             .form = "D|auto",
             .help = "End of the depth range with guaranteed shadow resolution, in units of the model; it clips "
                     "nothing",
             .statedAs = "near_and_far",
             .limit = Limit::FarDepth},
            orAuto(distance())),
        quality(
            &Quality::nearFloor,
            {.name = "near-floor",
             .form = "D",
             .help = "Min automatic value of --shadow-near, in units of the model",
             .usually = "--shadow-far / 10000",
             .statedAs = "near_floor"},
            ifGiven(distance())),
        lightSetting(),
        quality(
            &Quality::maxTriangles,
            {.name = "max-triangles",
             .form = "N",
             .help = "Max number of drawn triangles, such as 2M; Gnomon raises --error-pixels to respect it",
             .usually = "no limit",
             .statedAs = "max_triangles"},
            ifGiven(count())),
    };
}

/// Returns the settings for shadow maps that a bench does not sweep.
std::vector<Setting> fixedMapSettings() {
    return {
        plain(
            &Settings::eta,
            {.name = "eta",
             .form = "H",
             .help = "Parameter of the warp from -1 to 1 (Lloyd et al. 2006): -1 is none, 0 is LSPSM, 1 is PSM",
             .usually = "from --warp",
             .isOfMaps = true,
             .statedAs = "eta"},
            ifGiven(number("a number from -1 to 1", [](double v) { return v >= -1 && v <= 1; }))),
        plain(
            &Settings::tsmFocus,
            {.name = "tsm-focus",
             .form = "D|auto",
             .help = "With --warp tsm: distance of the focus from the near plane of a slice, in units of the model",
             .usually = "at the depth sqrt(near * far)",
             .isOfMaps = true,
             .statedAs = "tsm_focus"},
            ifGiven(distanceOrZero())),
        quality(
            &Quality::splitLambda,
            {.name = "split-lambda",
             .form = "L",
             .help = "Depths of the splits between slices: 0 is evenly spaced, 1 is logarithmic",
             .isOfMaps = true,
             .statedAs = "split_lambda"},
            number("a number from 0 to 1", [](double v) { return v >= 0 && v <= 1; })),
        quality(
            &Quality::emptySlices,
            {.name = "empty-slices",
             .form = {},
             .help = "Maps of slices without visible receivers: drop or keep (as in Lloyd et al. 2006)",
             .isOfMaps = true,
             .statedAs = "empty_slices"},
            oneOf(plan::kEmptySlices)),
        quality(
            &Quality::maxAliasing,
            {.name = "max-aliasing",
             .form = "M",
             .help = "Max perspective aliasing (texel width / pixel width) that the auto values stay below",
             .isOfMaps = true,
             .statedAs = "max_aliasing"},
            positiveNumber()),
    };
}

/// Returns the settings for the backend, its memory and its shaders.
std::vector<Setting> machineSettings() {
    return {
        plain(
            &Settings::backend,
            {.name = "backend", .form = "NAME", .help = "Renderer: auto, software, osmesa, egl (GPU), window"},
            oneOf(kBackends)),
        plain(
            &Settings::memory,
            {.name = "memory",
             .form = "SIZE",
             .help = "Max resident memory of the process; with OpenGL, of tables, page cache and sums of pictures only",
             .statedAs = "memory_cap",
             .limit = Limit::PageMemory},
            memory()),
        plain(
            &Settings::gpuMemory,
            {.name = "gpu-memory",
             .form = "SIZE",
             .help = "Max GPU memory for image, shadow maps and geometry",
             .changesPicture = false,
             .statedAs = "gpu_memory_cap",
             .limit = Limit::DrawingMemory},
            memory()),
        plain(
            &Settings::shaderFolder,
            {.name = "shaders", .form = "DIR", .help = "Folder with shaders that replace the built-in shaders"},
            text()),
    };
}

Setting shadowsSetting() {
    return {
        {.name = "shadows", .form = "KIND", .help = "Shadows: off, maps, exact, rays (slow) or auto", .isSwept = true},
        oneOf(plan::kShadowModes),
        [](const Settings& settings) {
            const Quality& quality = settings.quality;
            const bool meansMaps = quality.shadows == plan::ShadowMode::Auto && quality.mapsBecause;
            return meansMaps ? plan::ShadowMode::Maps : quality.shadows;
        },
        [](Settings& settings, plan::ShadowMode mode) { settings.quality.shadows = mode; }};
}

Setting warpSetting() {
    return {
        {.name = "warp",
         .form = "RULE",
         .help = "Warp of a shadow map: none, lspsm, psm, tsm, minimax, log (logarithmic rows) or auto",
         .isSwept = true,
         .isOfMaps = true,
         .offer = {.title = "warp"}},
        oneOf(shadow::kWarpRules),
        [](const Settings& settings) { return settings.quality.warp.rule; },
        [](Settings& settings, shadow::WarpRule rule) {
            settings.quality.warp.rule = rule;
            settings.isWarpGiven = true;
        }};
}

Setting shadowTexelsSetting() {
    return {
        {.name = "shadow-texels",
         .form = "WxH",
         .help = "Texels of all shadow maps, with borders",
         .isSwept = true,
         .isOfMaps = true,
         .limit = Limit::ShadowTexels,
         .offer = {.title = "shadow texels", .min = kMinOfferedTexels, .max = kMaxOfferedTexels}},
        textureSize(),
        [](const Settings& settings) {
            return Size{settings.quality.shadowTexelsWidth, settings.quality.shadowTexelsHeight};
        },
        [](Settings& settings, const Size& value) {
            settings.quality.shadowTexelsWidth = value[0];
            settings.quality.shadowTexelsHeight = value[1];
        }};
}

/// Returns the first settings that a bench sweeps: level of detail, shadow mode, warp, partitions and texels. A bench
/// nests its swept settings in the order of the table, and the last one varies fastest.
std::vector<Setting> sweptSettings() {
    return {
        quality(
            &Quality::errorPixels,
            {.name = "error-pixels",
             .form = "T",
             .help = "Max geometric error on the screen in pixels",
             .isSwept = true,
             .offer = {.title = "error pixels", .min = kMinOfferedErrorPixels, .max = kMaxOfferedErrorPixels}},
            positiveNumber()),
        shadowsSetting(),
        warpSetting(),
        quality(
            &Quality::zPartitions,
            {.name = "z-partitions",
             .form = "K|auto",
             .help = "Number of slices along the view, each with its own shadow maps",
             .isSwept = true,
             .isOfMaps = true,
             .offer = {.title = "slices", .min = 1, .max = kMaxSlices}},
            orAuto(whole(1, kMaxSlices))),
        quality(
            &Quality::facePartitions,
            {.name = "face-partitions",
             .form = {},
             .help = "Partitions along the faces of the view frustum",
             .isSwept = true,
             .isOfMaps = true,
             .offer = {.title = "faces"}},
            oneOf(plan::kChoices)),
        shadowTexelsSetting(),
    };
}

/// Returns the remaining settings that a bench sweeps: filter, caster culling, occlusion culling and stabilisation.
std::vector<Setting> moreSweptSettings() {
    return {
        quality(
            &Quality::filter,
            {.name = "filter",
             .form = "N",
             .help = "Width of the filter (PCF) of shadow maps in texels; 0 is no filter",
             .isSwept = true,
             .isOfMaps = true,
             .offer = {.title = "filter texels", .min = 0, .max = 9, .steps = {0, 2, 3, 5}}},
            whole(0, kMaxFilter)),
        quality(
            &Quality::cullCasters,
            {.name = "cull-casters",
             .form = "MODE",
             .help = "Triangles that a shadow map draws: off (all), on (those that can shadow its part of the view), "
                     "receivers (those that can shadow visible surfaces) or auto",
             .isSwept = true,
             .changesPicture = false,
             .offer = {.title = "caster culling"}},
            oneOf(plan::kCasterCullings)),
        quality(
            &Quality::occlusion,
            {.name = "occlusion",
             .form = {},
             .help = "Skip clusters behind visible surfaces (software backend); the picture stays identical",
             .isSwept = true,
             .changesPicture = false},
            oneOf(plan::kChoices)),
        quality(
            &Quality::stabilize,
            {.name = "stabilize",
             .form = {},
             .help = "Slices without warp that move by whole texels, so that shadow edges do not flicker",
             .isSwept = true,
             .isOfMaps = true,
             .offer = {.title = "stabilised slices"}},
            onOff()),
    };
}

bool agreeWhere(bool Description::*counts, const Settings& a, const Settings& b) {
    const auto all = table();
    return std::all_of(all.begin(), all.end(), [&](const Setting& each) {
        return !(each.description().*counts) || each.text(a) == each.text(b);
    });
}

} // namespace

std::span<const Setting> table() {
    static const std::vector<Setting> all = [] {
        std::vector<Setting> settings = cameraSettings();
        for (const auto& more :
             {sceneSettings(),
              sunSettings(),
              lookSettings(),
              fixedMapSettings(),
              machineSettings(),
              sweptSettings(),
              moreSweptSettings()})
            settings.insert(settings.end(), more.begin(), more.end());
        return settings;
    }();
    return all;
}

const Setting& named(std::string_view name) {
    const auto all = table();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Setting& each) { return each.name() == name; });
    GNOMON_CHECK(found != all.end());
    return *found;
}

bool isSetting(std::string_view name) {
    const auto all = table();
    return std::any_of(all.begin(), all.end(), [&](const Setting& each) { return each.name() == name; });
}

std::string optionText(const char* name, const Settings& settings) {
    const Setting& setting = named(name);
    return setting.option() + " " + setting.text(settings);
}

std::string optionsOf(std::span<const Limit> limits) {
    std::string options;
    for (const Setting& each : table()) {
        const std::optional<Limit>& limit = each.description().limit;
        if (!limit || std::find(limits.begin(), limits.end(), *limit) == limits.end()) continue;
        options += (options.empty() ? "" : ", ") + each.option();
    }
    return options;
}

bool appliesTo(const Setting& setting, const Settings& settings) {
    return !setting.description().isOfMaps || settings.quality.shadows != plan::ShadowMode::Exact;
}

bool areAlike(const Settings& a, const Settings& b) {
    return agreeWhere(&Description::isSwept, a, b);
}

bool drawAlike(const Settings& a, const Settings& b) {
    return agreeWhere(&Description::changesPicture, a, b);
}

} // namespace gnomon::settings
