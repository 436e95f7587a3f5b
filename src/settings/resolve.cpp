#include "settings/resolve.h"

#include "core/angle.h"
#include "hierarchy/main_part.h"
#include "path/camera_path.h"
#include "path/outline.h"
#include "settings/codec.h"
#include "settings/old_names.h"
#include "settings/sun_settings.h"
#include "settings/table.h"

#include <algorithm>
#include <vector>

namespace gnomon::settings {

namespace {

constexpr double kUsualFovYDegrees = 60;

shadow::Warp warpOf(const Settings& settings) {
    shadow::Warp warp = settings.quality.warp;
    if (settings.eta) {
        warp.rule = shadow::WarpRule::Eta;
        warp.eta = *settings.eta;
    }
    if (settings.tsmFocus.value_or(0) > 0) warp.tsmFocus = settings.tsmFocus;
    return warp;
}

/// Returns `given` with old names of settings replaced by the current names.
SettingTexts currentTexts(const SettingTexts& given) {
    SettingTexts texts;
    for (const auto& [name, text] : given)
        if (!texts.emplace(currentName(name), text).second) {
            const std::string option = "--" + std::string(currentName(name));
            throw UsageError{option, option + ": given twice, also by its old name"};
        }
    return texts;
}

} // namespace

bool isPosed(const Settings& settings) {
    return !settings.cameraFile.empty() || settings.eye || settings.target || settings.side || settings.fovYDegrees;
}

bool isFramed(const Settings& settings) {
    return !settings.camera && !settings.eye;
}

plan::View viewOf(
    const Settings& settings,
    const hierarchy::ModelSummary& summary,
    std::span<const glm::dvec3> outline,
    Framing framing) {
    plan::View view;
    view.width = settings.imageSize[0];
    view.height = settings.imageSize[1];
    view.up = settings.up.value_or(kAutoUp);
    if (view.up == kAutoUp) view.up = summary.up.direction;
    setSections(settings, view);
    setLight(settings, summary, view);
    if (settings.camera) {
        view.camera = *settings.camera;
        return view;
    }
    const double fovY = radiansFromDegrees(settings.fovYDegrees.value_or(kUsualFovYDegrees));
    const Box part = hierarchy::mainPartOf(summary);
    const std::vector<glm::dvec3> corners = path::cornersOf(part);
    std::vector<glm::dvec3> framed(outline.begin(), outline.end());
    if (framed.empty())
        framed = corners;
    else if (framing == Framing::EveryTurn)
        framed = path::sweptOutline(framed, part.center(), view.up);
    const path::Vantage vantage = path::vantageOf(settings.side, view.up);
    const auto frame =
        settings.projection == Projection::Orthographic ? path::orthographicFraming : path::framingCamera;
    view.camera = frame(framed, vantage, view.aspect(), fovY);
    if (settings.eye || settings.target) {
        view.camera.eye = settings.eye.value_or(view.camera.eye);
        view.camera.target = settings.target.value_or(0.5 * (corners.front() + corners.back()));
    }
    if (view.camera.eye == view.camera.target)
        throw UsageError{"--eye", "--eye and --target are the same point; change one of them"};
    return view;
}

void setSections(const Settings& settings, plan::View& view) {
    view.sections.clear();
    for (const Section& section : settings.sections) {
        const glm::dvec3 normal = glm::normalize(section.normal);
        view.sections.push_back({-normal, glm::dot(normal, section.point)});
    }
    view.cutsCasters = settings.sectionCasters == SectionCasters::Cut;
}

void requireDirectionalLight(const Settings& settings, const std::string& option) {
    if (settings.lightAt)
        throw UsageError{
            "--light-at", "--light-at and " + option + " contradict each other: it needs a light at infinite distance"};
}

Settings uprightIn(const Settings& settings, const hierarchy::ModelFile& model) {
    Settings upright = settings;
    if (settings.up == kAutoUp) upright.up = path::guessedUp(model).up.direction;
    return upright;
}

plan::View viewOf(const Settings& settings, const hierarchy::ModelFile& model, Framing framing) {
    const bool hasOutline = isFramed(settings) && framing != Framing::Path;
    const std::vector<glm::dvec3> outline = hasOutline ? path::outlineOf(model) : std::vector<glm::dvec3>();
    return viewOf(uprightIn(settings, model), model.summary(), outline, framing);
}

plan::Quality qualityOf(const Settings& settings) {
    plan::Quality quality = settings.quality;
    quality.warp = warpOf(settings);
    if (settings.lightAt && quality.look.shading == plan::Shading::Auto) quality.look.shading = plan::Shading::Lit;
    return quality;
}

void readCamera(Settings& settings, std::optional<double> time) {
    if (settings.cameraFile.empty()) return;
    settings.camera =
        time ? path::cameraAt(path::readCameraPath(settings.cameraFile), *time) : path::readCamera(settings.cameraFile);
    settings.camera->projection = settings.projection.value_or(settings.camera->projection);
}

void requireMapsFor(const std::string& option, const SettingTexts& texts) {
    const auto shadows = texts.find("shadows");
    if (shadows != texts.end() && shadows->second == wordOf(plan::kShadowModes, plan::ShadowMode::Exact))
        throw UsageError{
            "--shadows", "--shadows exact and " + option + " contradict each other: exact shadows have no maps"};
}

Settings settingsOf(const SettingTexts& given, bool withSwept) {
    const SettingTexts texts = currentTexts(given);
    std::size_t known = 0;
    for (const Setting& setting : table()) {
        if (!texts.contains(setting.name())) continue;
        ++known;
        if (setting.description().isOfMaps) requireMapsFor(setting.option(), texts);
    }
    if (known != texts.size()) // an unknown name is reported before invalid values
        for (const auto& [name, text] : texts)
            if (!isSetting(name)) {
                refuseRemovedOption("--" + name);
                throw UsageError{"--" + name, "--" + name + ": there is no such option"};
            }
    Settings result;
    for (const Setting& setting : table()) {
        const auto text = texts.find(setting.name());
        if (text != texts.end() && asksForMaps(setting)) askForMaps(result);
        if (text == texts.end() || (setting.description().isSwept && !withSwept)) continue;
        setting.set(result, setting.parse(text->second));
    }
    return result;
}

} // namespace gnomon::settings
