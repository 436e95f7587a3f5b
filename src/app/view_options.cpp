#include "app/view_options.h"

#include "app/camera_path.h"
#include "app/option_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace gnomon::app {

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

constexpr std::array kSweptOptions{
    SweptOption{
        "--error-pixels", "Level of detail: largest geometric error on the screen", &SweptSettings::errorPixels},
    SweptOption{"--shadows", "off, maps, or rays: the ray-traced reference", &SweptSettings::shadows},
    SweptOption{"--warp", "none|lspsm|psm|tsm|minimax|auto: how a map is warped", &SweptSettings::warp},
    SweptOption{"--z-partitions", "Slices along the view, or auto", &SweptSettings::zPartitions},
    SweptOption{"--face-partitions", "on|off|auto: split along the frustum's faces", &SweptSettings::facePartitions},
    SweptOption{"--shadow-texels", "WxH, a count: all maps together, gutters included", &SweptSettings::shadowTexels},
    SweptOption{"--filter", "PCF kernel in texels; 0 is none", &SweptSettings::filter},
    SweptOption{"--cull-casters", "on|off: partition culling", &SweptSettings::cullCasters},
    SweptOption{"--stabilize", "on|off: texel-snapped, unwarped slices", &SweptSettings::stabilize},
};

plan::ShadowMode shadowMode(const std::string& text) {
    static const std::map<std::string, plan::ShadowMode> words = {
        {"off", plan::ShadowMode::Off}, {"maps", plan::ShadowMode::Maps}, {"rays", plan::ShadowMode::Rays}};
    const auto found = words.find(text);
    if (found == words.end()) refuse("--shadows", text, "off, maps or rays");
    return found->second;
}

plan::Choice choice(const std::string& option, const std::string& text) {
    if (text == "auto") return plan::Choice::Auto;
    if (text != "on" && text != "off") refuse(option, text, "on, off or auto");
    return text == "on" ? plan::Choice::On : plan::Choice::Off;
}

shadow::Warp warp(const ViewOptions& options, const std::string& text) {
    using shadow::WarpRule;
    static const std::map<std::string, WarpRule> words = {
        {"none", WarpRule::None},
        {"lspsm", WarpRule::Lspsm},
        {"psm", WarpRule::Psm},
        {"tsm", WarpRule::Tsm},
        {"minimax", WarpRule::Minimax},
        {"auto", WarpRule::Auto}};
    const auto found = words.find(text);
    if (found == words.end()) refuse("--warp", text, "none, lspsm, psm, tsm, minimax or auto");
    shadow::Warp result;
    result.rule = found->second;
    if (!options.eta.empty()) {
        if (options.isWarpGiven) throw UsageError{"--eta and --warp contradict each other: eta is a warp of its own"};
        result.rule = WarpRule::Eta;
        result.eta = parseNumber("--eta", options.eta);
        if (!(result.eta >= -1 && result.eta <= 1)) refuse("--eta", options.eta, "a number from -1 to 1");
    }
    if (!options.tsmFocus.empty()) {
        if (result.rule != WarpRule::Tsm) throw UsageError{"--tsm-focus is for --warp tsm alone"};
        result.tsmFocus = parseNumberOrAuto("--tsm-focus", options.tsmFocus).value_or(0);
    }
    return result;
}

} // namespace

std::span<const SweptOption> sweptOptions() {
    return kSweptOptions;
}

void addViewOptions(CLI::App& command, ViewOptions& options) {
    const std::string group = "View and quality";
    const auto add = [&](const std::string& flag, std::string& value, const std::string& help) {
        return command.add_option(flag, value, help)->group(group)->capture_default_str();
    };
    add("--size", options.size, "Image in pixels, WxH");
    add("--camera", options.cameraFile, "A camera file: one keyframe as JSON");
    add("--eye", options.eye, "Where the eye is, x,y,z; frames the model if not given");
    add("--target", options.target, "What it looks at, x,y,z");
    add("--up", options.up, "What is up; 0,1,0 if not given");
    add("--fov-y", options.fovY, "Full vertical angle in degrees; 60 if not given");
    add("--near", options.near, "Where the depth range of the shadows' promise begins, or auto; clips nothing");
    add("--far", options.far, "Where it ends, or auto");
    add("--near-floor", options.nearFloor, "The least automatic near; far/10000 if not given");
    add("--light", options.light, "Direction towards the light, x,y,z");
    add("--max-triangles", options.maxTriangles, "A cap that raises the error evenly");
    add("--eta", options.eta, "The warp as eta in [-1, 1] of Lloyd et al. 2006: 0 is LSPSM, -1 none, 1 PSM");
    add("--tsm-focus", options.tsmFocus, "With --warp tsm: distance of the focus from near");
    add("--split-lambda", options.splitLambda, "Slice depths: 1 self-similar, 0 evenly spaced");
    add("--max-aliasing",
        options.maxAliasing,
        "With auto: the promise to stay under (perspective aliasing over [near, far])");
    for (const SweptOption& swept : kSweptOptions) {
        const bool isWarp = swept.value == &SweptSettings::warp;
        CLI::Option* option = add(swept.flag, options.swept.*swept.value, swept.help);
        if (isWarp) option->each([&options](const std::string& /*text*/) { options.isWarpGiven = true; });
    }
    add("--backend", options.backend, "auto|software|osmesa|egl|window: who executes the plan")
        ->check(CLI::IsMember({"auto", "software", "osmesa", "egl", "window"}));
    add("--memory", options.memory, "Tables and page cache");
    add("--gpu-memory", options.gpuMemory, "What the GPU holds");
    add("--shaders", options.shaders, "Read shaders from this folder instead of the built-in ones");
}

Camera framingCamera(const Box& bounds, double aspect, const glm::dvec3& up, double fovYRadians) {
    const double radius = std::max(glm::length(bounds.extent()) * 0.5, 1e-12);
    const double tanHalf = std::tan(fovYRadians / 2) * std::min(aspect, 1.0);
    const double distanceToCenter = radius / std::sin(std::atan(tanHalf));
    // Towards the viewer: up, and as far from up as an axis can be, so that any --up frames the model from its side.
    const glm::dvec3 side = std::abs(up.z) <= std::abs(up.y) ? glm::dvec3(0.45, 0, 1) : glm::dvec3(0.45, -1, 0);
    const glm::dvec3 level = glm::normalize(side - up * (glm::dot(side, up) / glm::dot(up, up)));
    const glm::dvec3 from = glm::normalize(level + 0.45 * glm::normalize(up));
    return {bounds.center() + from * distanceToCenter, bounds.center(), up, fovYRadians};
}

plan::View viewOf(const ViewOptions& options, const hierarchy::ModelSummary& summary) {
    plan::View view;
    const auto [width, height] = parseSize("--size", options.size);
    view.width = width;
    view.height = height;
    view.towardsLight = parseVector("--light", options.light);
    const bool isPosed =
        !options.eye.empty() || !options.target.empty() || !options.up.empty() || !options.fovY.empty();
    if (!options.cameraFile.empty()) {
        if (isPosed) throw UsageError{"--camera and --eye, --target, --up, --fov-y contradict each other"};
        view.camera = readCamera(options.cameraFile);
        return view;
    }
    const glm::dvec3 up = options.up.empty() ? glm::dvec3(0, 1, 0) : parseVector("--up", options.up);
    const double degrees = options.fovY.empty() ? 60 : parseNumber("--fov-y", options.fovY);
    if (!(degrees > 0 && degrees < 180)) refuse("--fov-y", options.fovY, "an angle above 0 and below 180 degrees");
    if (!(glm::length(up) > 0)) refuse("--up", options.up, "a direction");
    view.camera = framingCamera(summary.bounds, view.aspect(), up, degrees * kRadiansPerDegree);
    if (!options.eye.empty()) view.camera.eye = parseVector("--eye", options.eye);
    if (!options.target.empty()) view.camera.target = parseVector("--target", options.target);
    if (view.camera.eye == view.camera.target) throw UsageError{"--eye and --target are the same point"};
    if (!(glm::length(view.towardsLight) > 0)) refuse("--light", options.light, "a direction");
    return view;
}

plan::Quality qualityOf(const ViewOptions& options, const SweptSettings& swept) {
    plan::Quality quality;
    quality.shadows = shadowMode(swept.shadows);
    quality.warp = warp(options, swept.warp);
    if (swept.zPartitions == "auto")
        quality.zPartitions.reset();
    else
        quality.zPartitions = parseWhole("--z-partitions", swept.zPartitions, 1, kMaxSlices);
    quality.splitLambda = parseNumber("--split-lambda", options.splitLambda);
    if (!(quality.splitLambda >= 0 && quality.splitLambda <= 1))
        refuse("--split-lambda", options.splitLambda, "a number from 0 to 1");
    quality.facePartitions = choice("--face-partitions", swept.facePartitions);
    const auto [width, height] = parseSize("--shadow-texels", swept.shadowTexels);
    quality.shadowTexelsWidth = width;
    quality.shadowTexelsHeight = height;
    quality.maxAliasing = parseNumber("--max-aliasing", options.maxAliasing);
    if (!(quality.maxAliasing > 0)) refuse("--max-aliasing", options.maxAliasing, "a number above 0");
    quality.filter = parseWhole("--filter", swept.filter, 0, 16);
    quality.cullCasters = parseSwitch("--cull-casters", swept.cullCasters);
    quality.stabilize = parseSwitch("--stabilize", swept.stabilize);
    quality.near = parseNumberOrAuto("--near", options.near);
    quality.far = parseNumberOrAuto("--far", options.far);
    if (!options.nearFloor.empty()) quality.nearFloor = parseNumberOrAuto("--near-floor", options.nearFloor);
    if (quality.near && quality.far && !(*quality.near < *quality.far))
        throw UsageError{"--near and --far contradict each other: near must be below far"};
    quality.errorPixels = parseNumber("--error-pixels", swept.errorPixels);
    if (!(quality.errorPixels > 0)) refuse("--error-pixels", swept.errorPixels, "a number above 0");
    if (!options.maxTriangles.empty()) {
        quality.maxTriangles = parseCount(options.maxTriangles);
        if (!quality.maxTriangles || *quality.maxTriangles == 0)
            refuse("--max-triangles", options.maxTriangles, "a count such as 500k or 2M");
    }
    if (quality.stabilize && options.isWarpGiven && swept.warp != "none")
        throw UsageError{
            "--stabilize on and --warp " + swept.warp + " contradict each other: stabilised slices are unwarped"};
    return quality;
}

} // namespace gnomon::app
