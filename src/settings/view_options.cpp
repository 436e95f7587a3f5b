#include "settings/view_options.h"

#include "path/camera_path.h"
#include "settings/option_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace gnomon::settings {

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr int kMaxSide = 16384; // of an image and of the texture of all maps: what every executor can draw
constexpr std::int64_t kMaxShadowTexels = std::int64_t{kMaxSide} * kMaxSide;

constexpr std::array kSweptOptions{
    SweptOption{
        "--error-pixels", "T", "Level of detail: largest geometric error on the screen", &SweptSettings::errorPixels},
    SweptOption{
        "--shadows", "off|maps|rays", "None, shadow maps, or the ray-traced reference", &SweptSettings::shadows},
    SweptOption{"--warp", "none|lspsm|psm|tsm|minimax|auto", "How a map is warped", &SweptSettings::warp},
    SweptOption{"--z-partitions", "K|auto", "Slices along the view", &SweptSettings::zPartitions},
    SweptOption{"--face-partitions", "on|off|auto", "Split along the frustum's faces", &SweptSettings::facePartitions},
    SweptOption{"--shadow-texels", "WxH", "A count: all maps together, gutters included", &SweptSettings::shadowTexels},
    SweptOption{"--filter", "TEXELS", "PCF kernel; 0 is none", &SweptSettings::filter},
    SweptOption{"--cull-casters", "on|off", "Partition culling", &SweptSettings::cullCasters},
    SweptOption{"--stabilize", "on|off", "Texel-snapped, unwarped slices", &SweptSettings::stabilize},
};

constexpr std::array kPlainOptions{
    PlainOption{"--size", "WxH", "Image in pixels, WxH", &ViewOptions::size},
    PlainOption{"--camera", "FILE", "A camera file: one keyframe as JSON", &ViewOptions::cameraFile},
    PlainOption{"--eye", "x,y,z", "Where the eye is, x,y,z; frames the model if not given", &ViewOptions::eye},
    PlainOption{"--target", "x,y,z", "What it looks at, x,y,z", &ViewOptions::target},
    PlainOption{"--up", "x,y,z", "What is up; 0,1,0 if not given", &ViewOptions::up},
    PlainOption{"--fov-y", "DEGREES", "Full vertical angle in degrees; 60 if not given", &ViewOptions::fovY},
    PlainOption{
        "--near",
        "D|auto",
        "Where the depth range of the shadows' promise begins, or auto; clips nothing",
        &ViewOptions::near},
    PlainOption{"--far", "D|auto", "Where it ends, or auto", &ViewOptions::far},
    PlainOption{"--near-floor", "D", "The least automatic near; far/10000 if not given", &ViewOptions::nearFloor},
    PlainOption{"--light", "x,y,z", "Direction towards the light, x,y,z", &ViewOptions::light},
    PlainOption{"--max-triangles", "N", "A cap that raises the error evenly", &ViewOptions::maxTriangles},
    PlainOption{
        "--eta", "H", "The warp as eta in [-1, 1] of Lloyd et al. 2006: 0 is LSPSM, -1 none, 1 PSM", &ViewOptions::eta},
    PlainOption{"--tsm-focus", "D|auto", "With --warp tsm: distance of the focus from near", &ViewOptions::tsmFocus},
    PlainOption{"--split-lambda", "L", "Slice depths: 1 self-similar, 0 evenly spaced", &ViewOptions::splitLambda},
    PlainOption{
        "--max-aliasing",
        "M",
        "With auto: the promise to stay under (perspective aliasing over [near, far])",
        &ViewOptions::maxAliasing},
    PlainOption{
        "--backend",
        "WHO",
        "Who executes the plan: the software rasteriser, or GL from one of three places",
        &ViewOptions::backend},
    PlainOption{"--memory", "SIZE", "Tables and page cache", &ViewOptions::memory},
    PlainOption{"--gpu-memory", "SIZE", "What the GPU holds: image, maps and geometry", &ViewOptions::gpuMemory},
    PlainOption{
        "--shaders", "PATH", "Read shaders from this folder instead of the built-in ones", &ViewOptions::shaders},
};

/// `text` as a POSIX shell takes it for one word.
std::string forShell(const std::string& text) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.,/:@%";
    if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text)
        quoted += c == '\'' ? std::string(R"('\'')") : std::string(1, c);
    return quoted + "'";
}

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

/// Nothing for "auto", else a distance whose ratios and products a float can still hold.
std::optional<double> distance(const std::string& option, const std::string& text) {
    constexpr double kLeast = 1e-15;
    constexpr double kMost = 1e15;
    const std::optional<double> value = parseNumberOrAuto(option, text);
    if (value && !(*value >= kLeast && *value <= kMost)) refuse(option, text, "auto or a distance from 1e-15 to 1e15");
    return value;
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
        result.tsmFocus = distance("--tsm-focus", options.tsmFocus).value_or(0);
    }
    return result;
}

/// Whether there is more or less of a camera beside a camera file.
bool hasPose(const ViewOptions& options) {
    return !options.eye.empty() || !options.target.empty() || !options.up.empty() || !options.fovY.empty();
}

} // namespace

std::span<const SweptOption> sweptOptions() {
    return kSweptOptions;
}

std::span<const PlainOption> plainOptions() {
    return kPlainOptions;
}

std::string columnName(const std::string& flag) {
    std::string name = flag.substr(flag.find_first_not_of('-'));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

bool isPosed(const ViewOptions& options) {
    return !options.cameraFile.empty() || hasPose(options);
}

std::string plainOptionsToPaste(const ViewOptions& options) {
    const ViewOptions defaults;
    std::string text;
    for (const PlainOption& plain : kPlainOptions) {
        const std::string& value = options.*plain.value;
        if (value != defaults.*plain.value)
            text += (text.empty() ? "" : " ") + std::string(plain.flag) + " " + forShell(value);
    }
    return text;
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

std::array<int, 2> imageSize(const ViewOptions& options) {
    const std::array<int, 2> size = parseSize("--size", options.size);
    if (std::max(size[0], size[1]) > kMaxSide)
        refuse("--size", options.size, "sides of at most " + std::to_string(kMaxSide) + " pixels");
    return size;
}

plan::View viewOf(const ViewOptions& options, const hierarchy::ModelSummary& summary) {
    plan::View view;
    const auto [width, height] = imageSize(options);
    view.width = width;
    view.height = height;
    view.towardsLight = parseDirection("--light", options.light);
    if (!options.cameraFile.empty()) {
        if (hasPose(options)) throw UsageError{"--camera and --eye, --target, --up, --fov-y contradict each other"};
        view.camera = path::readCamera(options.cameraFile);
        return view;
    }
    const glm::dvec3 up = options.up.empty() ? glm::dvec3(0, 1, 0) : parseDirection("--up", options.up);
    const double degrees = options.fovY.empty() ? 60 : parseNumber("--fov-y", options.fovY);
    if (!(degrees > 0 && degrees < 180)) refuse("--fov-y", options.fovY, "an angle above 0 and below 180 degrees");
    view.camera = framingCamera(summary.bounds, view.aspect(), up, degrees * kRadiansPerDegree);
    if (!options.eye.empty()) view.camera.eye = parseVector("--eye", options.eye);
    if (!options.target.empty()) view.camera.target = parseVector("--target", options.target);
    if (view.camera.eye == view.camera.target) throw UsageError{"--eye and --target are the same point"};
    return view;
}

namespace {

void requireNoWarpIfStable(const ViewOptions& options, const SweptSettings& swept, const plan::Quality& quality) {
    const bool isWarpGiven = options.isWarpGiven && quality.warp.rule != shadow::WarpRule::None;
    const bool isEtaGiven = !options.eta.empty() && quality.warp.eta != -1;
    if (quality.stabilize && (isWarpGiven || isEtaGiven))
        throw UsageError{
            "--stabilize on and " + (isEtaGiven ? "--eta " + options.eta : "--warp " + swept.warp) +
            " contradict each other: stabilised slices are unwarped"};
}

} // namespace

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
    if (std::int64_t{width} * height > kMaxShadowTexels)
        refuse("--shadow-texels", swept.shadowTexels, "at most 16384x16384 texels, the largest texture");
    quality.shadowTexelsWidth = width;
    quality.shadowTexelsHeight = height;
    quality.maxAliasing = parseNumber("--max-aliasing", options.maxAliasing);
    if (!(quality.maxAliasing > 0)) refuse("--max-aliasing", options.maxAliasing, "a number above 0");
    quality.filter = parseWhole("--filter", swept.filter, 0, 16);
    quality.cullCasters = parseSwitch("--cull-casters", swept.cullCasters);
    quality.stabilize = parseSwitch("--stabilize", swept.stabilize);
    quality.near = distance("--near", options.near);
    quality.far = distance("--far", options.far);
    if (!options.nearFloor.empty()) quality.nearFloor = distance("--near-floor", options.nearFloor);
    if (quality.near && quality.far && !(*quality.near < *quality.far))
        throw UsageError{"--near and --far contradict each other: near must be below far"};
    quality.errorPixels = parseNumber("--error-pixels", swept.errorPixels);
    if (!(quality.errorPixels > 0)) refuse("--error-pixels", swept.errorPixels, "a number above 0");
    if (!options.maxTriangles.empty()) {
        quality.maxTriangles = parseCount(options.maxTriangles);
        if (!quality.maxTriangles || *quality.maxTriangles == 0)
            refuse("--max-triangles", options.maxTriangles, "a count such as 500k or 2M");
    }
    requireNoWarpIfStable(options, swept, quality);
    return quality;
}

} // namespace gnomon::settings
