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

/// Returns the codec for a distance or "auto", whose value is 0.
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

/// Returns the settings of the image size and the camera.
std::vector<Setting> cameraSettings() {
    return {
        plain(
            &Settings::imageSize,
            {.name = "size",
             .form = "WxH",
             .help = "Image in pixels, WxH",
             .statedAs = "image_size",
             .limit = Limit::ImageSize},
            imageSize()),
        plain(
            &Settings::cameraFile,
            {.name = "camera", .form = "FILE", .help = "A camera file: one keyframe as JSON"},
            text()),
        plain(
            &Settings::eye,
            {.name = "eye", .form = "x,y,z", .help = "Where the eye is, x,y,z; frames the model if not given"},
            ifGiven(vector())),
        plain(
            &Settings::target,
            {.name = "target", .form = "x,y,z", .help = "What it looks at, x,y,z"},
            ifGiven(vector())),
        plain(
            &Settings::up,
            {.name = "up",
             .form = "AXIS|x,y,z",
             .help = "What is up: x, y, z, -x, -y, -z, a direction, or auto: guessed; as stored in the "
                     "model if not given"},
            ifGiven(upDirection())),
        plain(
            &Settings::side,
            {.name = "view",
             .form = enumerated(path::kViewSides, "|", "|"),
             .help = "The side from which the model is framed; from the front, a little right and above if not given"},
            ifGiven(oneOf(path::kViewSides))),
        plain(
            &Settings::fovYDegrees,
            {.name = "fov-y",
             .form = "DEGREES",
             .help = "Full vertical angle in degrees; 60 if not given",
             .limit = Limit::FieldOfView},
            ifGiven(number("an angle above 0 and below 180 degrees", [](double v) { return v > 0 && v < 180; }))),
    };
}

Setting lightSetting() {
    return {
        {.name = "light",
         .form = "x,y,z",
         .help =
             "Direction towards the light, x,y,z; 0.4,1,0.3 of a model with y up, the same turned with it of others",
         .statedAs = "light",
         .limit = Limit::LightDirection},
        direction(),
        [](const Settings& settings) { return settings.towardsLight; },
        [](Settings& settings, const glm::dvec3& value) {
            settings.towardsLight = value;
            settings.isLightGiven = true;
        }};
}

/// Returns the settings of the depth range of the aliasing bound, the directional light, and the max number of
/// triangles.
std::vector<Setting> sceneSettings() {
    return {
        quality(
            &Quality::near,
            {.name = "near",
             .form = "D|auto",
             .help = "Where the depth range of the shadows' promise begins, or auto; clips nothing",
             .statedAs = "near_and_far",
             .limit = Limit::NearDepth},
            orAuto(distance())),
        quality(
            &Quality::far,
            {.name = "far",
             .form = "D|auto",
             .help = "Where it ends, or auto",
             .statedAs = "near_and_far",
             .limit = Limit::FarDepth},
            orAuto(distance())),
        quality(
            &Quality::nearFloor,
            {.name = "near-floor",
             .form = "D",
             .help = "The least automatic near; far/10000 if not given",
             .statedAs = "near_floor"},
            ifGiven(distance())),
        lightSetting(),
        quality(
            &Quality::maxTriangles,
            {.name = "max-triangles",
             .form = "N",
             .help = "A cap that raises the error evenly",
             .statedAs = "max_triangles"},
            ifGiven(count())),
    };
}

/// Returns the settings of shadow maps that a bench does not sweep.
std::vector<Setting> fixedMapSettings() {
    return {
        plain(
            &Settings::eta,
            {.name = "eta",
             .form = "H",
             .help = "The warp as eta in [-1, 1] of Lloyd et al. 2006: 0 is LSPSM, -1 none, 1 PSM",
             .isOfMaps = true,
             .statedAs = "eta"},
            ifGiven(number("a number from -1 to 1", [](double v) { return v >= -1 && v <= 1; }))),
        plain(
            &Settings::tsmFocus,
            {.name = "tsm-focus",
             .form = "D|auto",
             .help =
                 "With --warp tsm: distance of the focus from near; at depth sqrt(near far) of each slice if not given",
             .isOfMaps = true,
             .statedAs = "tsm_focus"},
            ifGiven(distanceOrZero())),
        quality(
            &Quality::splitLambda,
            {.name = "split-lambda",
             .form = "L",
             .help = "Slice depths: 1 self-similar, 0 evenly spaced",
             .isOfMaps = true,
             .statedAs = "split_lambda"},
            number("a number from 0 to 1", [](double v) { return v >= 0 && v <= 1; })),
        quality(
            &Quality::maxAliasing,
            {.name = "max-aliasing",
             .form = "M",
             .help = "With auto: the promise to stay under (perspective aliasing over [near, far])",
             .isOfMaps = true,
             .statedAs = "max_aliasing"},
            positiveNumber()),
    };
}

/// Returns the settings of the backend, its memory and its shaders.
std::vector<Setting> machineSettings() {
    return {
        plain(
            &Settings::backend,
            {.name = "backend",
             .form = "BACKEND:" + enumerated(kBackends, "|", "|"),
             .help = "What draws: the software rasteriser, or OpenGL by OSMesa, EGL or the window; auto: software for "
                     "one picture, "
                     "else a GPU if there is one that can draw the requested options"},
            oneOf(kBackends)),
        plain(
            &Settings::memory,
            {.name = "memory",
             .form = "SIZE",
             .help = "Peak resident size of the process; with OpenGL, of tables, page cache and sums of pictures alone",
             .statedAs = "memory_cap",
             .limit = Limit::PageMemory},
            memory()),
        plain(
            &Settings::gpuMemory,
            {.name = "gpu-memory",
             .form = "SIZE",
             .help = "What the GPU holds: image, maps and geometry",
             .changesPicture = false,
             .statedAs = "gpu_memory_cap",
             .limit = Limit::DrawingMemory},
            memory()),
        plain(
            &Settings::shaderFolder,
            {.name = "shaders", .form = "PATH", .help = "Read shaders from this folder instead of the built-in ones"},
            text()),
    };
}

Setting shadowsSetting() {
    return {
        {.name = "shadows",
         .form = {},
         .help = "None, shadow maps, exact ones (software backend), the ray-traced reference; auto: exact with the "
                 "software backend, maps with OpenGL or beside an option of maps",
         .isSwept = true},
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
         .form = {},
         .help = "How a map is warped",
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
         .help = "A count: all maps together, gutters included",
         .isSwept = true,
         .isOfMaps = true,
         .limit = Limit::ShadowTexels,
         .offer = {.title = "shadow texels", .least = kLeastOfferedTexels, .most = kMostOfferedTexels}},
        textureSize(),
        [](const Settings& settings) {
            return Size{settings.quality.shadowTexelsWidth, settings.quality.shadowTexelsHeight};
        },
        [](Settings& settings, const Size& value) {
            settings.quality.shadowTexelsWidth = value[0];
            settings.quality.shadowTexelsHeight = value[1];
        }};
}

/// Returns swept settings of a bench: level of detail, shadow mode, warp, partitions and texels. A bench nests its axes
/// in the order of the table, and the last axis varies fastest.
std::vector<Setting> sweptSettings() {
    return {
        quality(
            &Quality::errorPixels,
            {.name = "error-pixels",
             .form = "T",
             .help = "Level of detail: largest geometric error on the screen",
             .isSwept = true,
             .offer = {.title = "error pixels", .least = kLeastOfferedErrorPixels, .most = kMostOfferedErrorPixels}},
            positiveNumber()),
        shadowsSetting(),
        warpSetting(),
        quality(
            &Quality::zPartitions,
            {.name = "z-partitions",
             .form = "K|auto",
             .help = "Slices along the view",
             .isSwept = true,
             .isOfMaps = true,
             .offer = {.title = "slices", .least = 1, .most = kMaxSlices}},
            orAuto(whole(1, kMaxSlices))),
        quality(
            &Quality::facePartitions,
            {.name = "face-partitions",
             .form = {},
             .help = "Split along the frustum's faces",
             .isSwept = true,
             .isOfMaps = true,
             .offer = {.title = "faces"}},
            oneOf(plan::kChoices)),
        shadowTexelsSetting(),
    };
}

/// Returns the other swept settings of a bench: filter, caster culling, occlusion culling and stabilisation.
std::vector<Setting> moreSweptSettings() {
    return {
        quality(
            &Quality::filter,
            {.name = "filter",
             .form = "TEXELS",
             .help = "PCF kernel, its ends weighted; 0 is none",
             .isSwept = true,
             .isOfMaps = true,
             .offer = {.title = "filter texels", .least = 0, .most = 9, .steps = {0, 2, 3, 5}}},
            whole(0, kMaxFilter)),
        quality(
            &Quality::cullCasters,
            {.name = "cull-casters",
             .form = {},
             .help = "What maps draw: all (off), what can shadow their part (on), what is looked up (receivers)",
             .isSwept = true,
             .changesPicture = false,
             .offer = {.title = "caster culling"}},
            oneOf(plan::kCasterCullings)),
        quality(
            &Quality::occlusion,
            {.name = "occlusion",
             .form = {},
             .help = "Draw the image without what it hides, the same to the last bit (software backend); auto: where "
                     "much lies behind what is seen",
             .isSwept = true,
             .changesPicture = false},
            oneOf(plan::kChoices)),
        quality(
            &Quality::stabilize,
            {.name = "stabilize",
             .form = {},
             .help = "Texel-snapped, unwarped slices",
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
