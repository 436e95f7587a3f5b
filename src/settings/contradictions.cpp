#include "settings/contradictions.h"

#include "render/picture_series.h"
#include "settings/backend_choice.h"
#include "settings/files/named_files.h"
#include "settings/resolve.h"
#include "settings/sun_settings.h"
#include "settings/table.h"

#include <algorithm>

namespace gnomon::settings {

namespace {

using Condition = bool (*)(const Request&);

// Functions that tell whether the user gave an option. The options are no settings, or their values do not show this.
constexpr OptionUse kPath{"path", [](const Request& r) { return !r.output.path.empty(); }};
constexpr OptionUse kTurntable{"turntable", [](const Request& r) { return r.output.turntable > 0; }};
constexpr OptionUse kLight{"light", [](const Request& r) { return r.settings.isLightGiven; }};
constexpr OptionUse kOverlay{"overlay", [](const Request& r) { return r.output.overlay != render::Overlay::None; }};
constexpr OptionUse kColorBy{"color-by", [](const Request& r) { return r.output.colors.by != ColorBy::None; }};
constexpr OptionUse kStats{"stats", [](const Request& r) { return !r.output.statistics.empty(); }};
constexpr OptionUse kOracle{
    "oracle", [](const Request& r) { return r.output.groundTruth != validation::GroundTruth::None; }};
constexpr OptionUse kDepth{"depth", [](const Request& r) { return !r.output.depth.empty(); }};
constexpr OptionUse kShadowClasses{"shadow-classes", [](const Request& r) { return !r.output.shadowClasses.empty(); }};
constexpr OptionUse kShadowDepth{"shadow-depth", [](const Request& r) { return !r.output.shadowDepth.empty(); }};
constexpr OptionUse kReference{"reference", [](const Request& r) { return !r.output.reference.empty(); }};
constexpr OptionUse kTime{"time", [](const Request& r) { return r.output.time.has_value(); }};
constexpr OptionUse kWarp{"warp", [](const Request& r) {
                              return r.settings.isWarpGiven && r.settings.quality.warp.rule != shadow::WarpRule::None;
                          }};

OptionUse samples(Condition isUsed) {
    return {"samples", isUsed, [](const Request& r) { return "--samples " + std::to_string(*r.output.samples); }};
}

OptionUse transparent() {
    return {"background", [](const Request& r) {
                return r.settings.quality.look.background.kind == plan::Background::Kind::Transparent;
            }};
}

std::vector<Contradiction> cameraContradictions() {
    const char* const path = "the path contains the cameras";
    return {
        {{"camera"}, {{"eye"}, {"target"}, {"view"}, {"fov-y"}}, "the camera file contains all values of the camera"},
        {{"view"}, {{"eye"}, {"target"}}, "--view sets the position of the camera"},
        {kPath, {{"camera"}, {"eye"}, {"target"}, {"view"}, {"fov-y"}}, path},
        {kPath, {kTurntable}, "each of them sets the cameras"},
    };
}

std::vector<Contradiction> lightContradictions() {
    return {
        {{"sun"}, {kLight}, "each of them sets the light"},
        {{"light-at"}, {kLight, {"sun"}}, "each of them sets the light"},
        {{"light-at"}, {{"sun-angle"}}, "the light of a lamp has no width"},
        {{"light-at"},
         {kWarp, {"eta"}, {"z-partitions"}, {"split-lambda"}, {"empty-slices"}, {"face-partitions"}, {"stabilize"}},
         "the maps of a lamp are the faces of a cube around it"},
        {{"light-at"}, {{"ground"}}, "the ground shows the shadow of a direction"},
        {{"shading", [](const Request& r) { return plan::hasNoSun(r.settings.quality.look.shading); }},
         {{"shadows",
           [](const Request& r) {
               const plan::ShadowMode mode = r.settings.quality.shadows;
               return mode != plan::ShadowMode::Auto && mode != plan::ShadowMode::Off;
           }},
          {"shadows",
           [](const Request& r) {
               const plan::Quality& quality = r.settings.quality;
               return quality.shadows == plan::ShadowMode::Auto && quality.mapsBecause.has_value();
           },
           [](const Request&) { return std::string("options of shadow maps"); }}},
         "this shading has no sun and no shadows"},
    };
}

std::vector<Contradiction> mapContradictions() {
    return {
        {{"eta"}, {{"warp", [](const Request& r) { return r.settings.isWarpGiven; }}}, "--eta sets the warp"},
        {{"stabilize"},
         {kWarp, {"eta", [](const Request& r) { return r.settings.eta.value_or(-1) != -1; }}},
         "stabilised slices have no warp"},
        {{"shadow-near"},
         {{"shadow-far",
           [](const Request& r) {
               const plan::Quality& quality = r.settings.quality;
               return quality.near && quality.far && !(*quality.near < *quality.far);
           }}},
         "--shadow-near must be below --shadow-far"},
        {kShadowDepth,
         {{"shadows", [](const Request& r) { return r.settings.quality.shadows == plan::ShadowMode::Exact; }}},
         "exact shadows have no maps"},
        {kShadowClasses,
         {{"shadows", [](const Request& r) { return r.settings.quality.shadows == plan::ShadowMode::Off; }},
          {"shading", [](const Request& r) { return plan::hasNoSun(r.settings.quality.look.shading); }}},
         "pixels have shadow classes only with a light and shadows"},
    };
}

std::vector<Contradiction> outputContradictions() {
    const std::vector<OptionUse> ofOneFrame = {
        kOverlay, kColorBy, kStats, kOracle, kDepth, kShadowClasses, kShadowDepth};
    std::vector<OptionUse> asksForOneFrame = ofOneFrame;
    asksForOneFrame.push_back(samples([](const Request& r) { return r.output.samples == 1; }));
    asksForOneFrame.push_back(
        {"reference", [](const Request& r) { return !r.output.reference.empty() && !r.output.samples; }});
    const std::vector<OptionUse> ofOnePicture = {
        kStats, kReference, kDepth, kShadowClasses, kShadowDepth, kOracle, kTime};
    return {
        {kColorBy, {kOverlay, kPath, kTurntable}, "it colours one picture without an overlay"},
        {kPath, ofOnePicture, "it needs a single picture"},
        {kTurntable, ofOnePicture, "it needs a single picture"},
        {samples([](const Request& r) { return r.output.samples.value_or(1) > 1; }),
         ofOneFrame,
         "it needs a single frame; use --samples 1"},
        {{"sky", [](const Request& r) { return r.settings.quality.sky.directions > 0; }},
         asksForOneFrame,
         "the light of the sky needs several frames"},
        {{"sun-angle", [](const Request& r) { return r.settings.sunAngleDegrees.value_or(0) > 0; }},
         asksForOneFrame,
         "the light of a disc needs several frames"},
        {transparent(), {kOverlay, kColorBy}, "their legend needs a background"},
        {transparent(),
         {{"output",
           [](const Request& r) { return r.output.isSeries() && r.output.picture == "-"; },
           [](const Request&) { return std::string("-o -"); }}},
         "YUV4MPEG2 has no alpha"},
    };
}

bool isUsed(const OptionUse& use, const Request& request) {
    return use.isUsed != nullptr ? use.isUsed(request) : !named(use.option).isDefault(request.settings);
}

std::string written(const OptionUse& use, const Request& request) {
    if (use.written != nullptr) return use.written(request);
    return isSetting(use.option) ? optionText(use.option, request.settings) : std::string("--") + use.option;
}

void requireFiles(const Request& request) {
    const Output& output = request.output;
    const bool isStream = output.isSeries() && output.picture == "-";
    if (!isStream) requireExtension("--output", output.picture, ".png");
    if (!output.shadowClasses.empty()) requireExtension("--shadow-classes", output.shadowClasses, ".png");
    if (output.isSeries()) {
        if (!isStream && !render::numberedName(output.picture, 0))
            refuse("--output", output.picture, "- or a name with a number in it, such as frame%04d.png");
        return;
    }
    requireDistinctFiles(
        {{"MODEL", request.model}, {"--camera", request.settings.cameraFile}, {"--reference", output.reference}},
        {{"--output", output.picture},
         {"--stats", output.statistics},
         {"--depth", output.depth},
         {"--shadow-classes", output.shadowClasses}});
}

} // namespace

std::span<const Contradiction> contradictions() {
    static const std::vector<Contradiction> all = [] {
        std::vector<Contradiction> rows = cameraContradictions();
        for (const auto& more : {lightContradictions(), mapContradictions(), outputContradictions()})
            rows.insert(rows.end(), more.begin(), more.end());
        return rows;
    }();
    return all;
}

std::span<const Requirement> requirements() {
    static const std::vector<Requirement> all = {
        {{"north"}, [](const Request& r) { return r.settings.sun.has_value(); }, "--sun LAT,LON,TIME"},
        {{"tsm-focus"},
         [](const Request& r) { return !r.settings.eta && r.settings.quality.warp.rule == shadow::WarpRule::Tsm; },
         "--warp tsm"},
        {kTime, [](const Request& r) { return !r.settings.cameraFile.empty(); }, "a path: --camera PATH.json"},
        {{"frames", [](const Request& r) { return r.output.frames.has_value(); }},
         kPath.isUsed,
         "--path FILE.json; --turntable N gives the number of its pictures"},
    };
    return all;
}

void requireSound(const Request& request) {
    for (const Contradiction& each : contradictions()) {
        if (!isUsed(each.option, request)) continue;
        for (const OptionUse& other : each.others)
            if (isUsed(other, request))
                throw UsageError{
                    std::string("--") + each.option.option,
                    written(each.option, request) + " and " + written(other, request) +
                        " contradict each other: " + each.reason};
    }
    for (const Requirement& each : requirements())
        if (isUsed(each.option, request) && !each.isMet(request))
            throw UsageError{
                std::string("--") + each.option.option, written(each.option, request) + " needs " + each.needed};
    requireCapable(request.settings, request.output.colors);
    if (request.settings.sun) requireSunUp(*request.settings.sun);
    if (!request.output.picture.empty()) requireFiles(request);
}

void requireSound(const Settings& settings) {
    requireSound(Request{{}, settings, {}});
}

} // namespace gnomon::settings
