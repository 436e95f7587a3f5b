#include "settings/resolve.h"

#include "core/angle.h"
#include "path/camera_path.h"
#include "settings/table.h"

#include <algorithm>
#include <cmath>

namespace gnomon::settings {

namespace {

constexpr double kUsualFovYDegrees = 60;

/// The option of a setting and its value, as they are written: "--eta 0.5".
std::string written(const char* name, const Settings& settings) {
    const Setting& setting = named(name);
    return setting.option() + " " + setting.text(settings);
}

/// Whether there is more or less of a camera beside a camera file.
bool hasPose(const Settings& settings) {
    return settings.eye || settings.target || settings.up || settings.fovYDegrees;
}

shadow::Warp warpOf(const Settings& settings) {
    shadow::Warp warp = settings.quality.warp;
    if (settings.eta) {
        if (settings.isWarpGiven) throw UsageError{"--eta and --warp contradict each other: eta is a warp of its own"};
        warp.rule = shadow::WarpRule::Eta;
        warp.eta = *settings.eta;
    }
    if (settings.tsmFocus) {
        if (warp.rule != shadow::WarpRule::Tsm) throw UsageError{"--tsm-focus is for --warp tsm alone"};
        if (*settings.tsmFocus > 0) warp.tsmFocus = settings.tsmFocus;
    }
    return warp;
}

void requireNoWarpIfStable(const Settings& settings) {
    if (!settings.quality.stabilize) return;
    const bool hasWarp = settings.isWarpGiven && settings.quality.warp.rule != shadow::WarpRule::None;
    const bool hasEta = settings.eta && *settings.eta != -1;
    if (hasWarp || hasEta)
        throw UsageError{
            written("stabilize", settings) + " and " + written(hasEta ? "eta" : "warp", settings) +
            " contradict each other: stabilised slices are unwarped"};
}

void requireSoftwareIfNeeded(const Settings& settings) {
    const bool isGl = settings.backend != Backend::Auto && settings.backend != Backend::Software;
    if (isGl && settings.quality.shadows == plan::ShadowMode::Exact)
        throw UsageError{
            written("backend", settings) + " and " + written("shadows", settings) +
            " contradict each other: only the software executor decides shadows exactly"};
    if (isGl && settings.quality.cullCasters == plan::CasterCulling::Receivers)
        throw UsageError{
            written("backend", settings) + " and " + written("cull-casters", settings) +
            " contradict each other: only the software executor finds receivers before it draws maps"};
    if (isGl && settings.quality.occlusion == plan::Choice::On)
        throw UsageError{
            written("backend", settings) + " and " + written("occlusion", settings) +
            " contradict each other: only the software executor leaves out what is hidden"};
}

/// Whether options ask for shadows, or for maps of them.
bool asksForShadows(const plan::Quality& quality) {
    using plan::ShadowMode;
    if (quality.shadows == ShadowMode::Auto) return quality.mapsBecause.has_value();
    return quality.shadows != ShadowMode::Off;
}

void requireSunIfShadowed(const Settings& settings) {
    if (!plan::isWithoutSun(settings.quality.look.shading) || !asksForShadows(settings.quality)) return;
    const bool isAuto = settings.quality.shadows == plan::ShadowMode::Auto;
    throw UsageError{
        written("shading", settings) + " and " + (isAuto ? "options of shadow maps" : written("shadows", settings)) +
        " contradict each other: there is no sun to throw shadows"};
}

} // namespace

bool isPosed(const Settings& settings) {
    return !settings.cameraFile.empty() || hasPose(settings);
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

plan::View viewOf(const Settings& settings, const hierarchy::ModelSummary& summary) {
    plan::View view;
    view.width = settings.imageSize[0];
    view.height = settings.imageSize[1];
    view.towardsLight = settings.towardsLight;
    view.up = settings.up.value_or(glm::dvec3(0, 1, 0));
    if (!settings.cameraFile.empty()) {
        if (hasPose(settings)) throw UsageError{"--camera and --eye, --target, --up, --fov-y contradict each other"};
        view.camera = path::readCamera(settings.cameraFile);
        return view;
    }
    const glm::dvec3 up = settings.up.value_or(glm::dvec3(0, 1, 0));
    const double degrees = settings.fovYDegrees.value_or(kUsualFovYDegrees);
    view.camera = framingCamera(summary.bounds, view.aspect(), up, radiansFromDegrees(degrees));
    view.camera.eye = settings.eye.value_or(view.camera.eye);
    view.camera.target = settings.target.value_or(view.camera.target);
    if (view.camera.eye == view.camera.target) throw UsageError{"--eye and --target are the same point"};
    return view;
}

plan::Quality qualityOf(const Settings& settings) {
    plan::Quality quality = settings.quality;
    quality.warp = warpOf(settings);
    if (quality.near && quality.far && !(*quality.near < *quality.far))
        throw UsageError{"--near and --far contradict each other: near must be below far"};
    requireNoWarpIfStable(settings);
    requireSoftwareIfNeeded(settings);
    requireSunIfShadowed(settings);
    return quality;
}

} // namespace gnomon::settings
