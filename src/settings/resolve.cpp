#include "settings/resolve.h"

#include "core/angle.h"
#include "hierarchy/main_part.h"
#include "path/camera_path.h"
#include "path/outline.h"
#include "settings/backend_choice.h"
#include "settings/codec.h"
#include "settings/sun_settings.h"
#include "settings/table.h"

#include <algorithm>
#include <vector>

namespace gnomon::settings {

namespace {

constexpr double kUsualFovYDegrees = 60;

/// Returns true if options other than --camera give parts of a camera.
bool hasPose(const Settings& settings) {
    return settings.eye || settings.target || settings.side || settings.fovYDegrees;
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

/// Returns true if options request shadows, or settings of shadow maps.
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

namespace {

void requireOneCamera(const Settings& settings) {
    if (!settings.cameraFile.empty() && hasPose(settings))
        throw UsageError{"--camera and --eye, --target, --view, --fov-y contradict each other"};
    if (settings.side && (settings.eye || settings.target))
        throw UsageError{"--view and --eye, --target contradict each other: it frames the model from a side"};
}

} // namespace

namespace {

glm::dvec3 lightOf(const Settings& settings, const glm::dvec3& up) {
    if (settings.sun && settings.isLightGiven) throw UsageError{"--light and --sun contradict each other"};
    if (settings.north && !settings.sun) throw UsageError{"--north is of --sun LAT,LON,TIME"};
    if (settings.sun) return towardsSun(*settings.sun, settings.north.value_or(0), up);
    return settings.isLightGiven ? settings.towardsLight : path::usualLight(up);
}

} // namespace

namespace {

/// Returns the vector from the centre of `bounds` to the point light. Returns `up` if the light is at the centre.
glm::dvec3 towardsPoint(const plan::PointLight& light, const Box& bounds, const glm::dvec3& up) {
    const glm::dvec3 towards = light.at - 0.5 * (bounds.min + bounds.max);
    return towards == glm::dvec3(0) ? up : towards;
}

/// Throws UsageError for options of slices, face partitions, warps and stabilisation. The maps of a point light are the
/// six faces of a cube, so these options do not apply.
void requireCubeMaps(const Settings& settings) {
    const plan::Quality usual;
    const plan::Quality& quality = settings.quality;
    std::string option;
    if (settings.isWarpGiven && quality.warp.rule != shadow::WarpRule::None) option = written("warp", settings);
    if (settings.eta) option = written("eta", settings);
    if (quality.zPartitions != usual.zPartitions) option = written("z-partitions", settings);
    if (quality.splitLambda != usual.splitLambda) option = written("split-lambda", settings);
    if (quality.facePartitions != usual.facePartitions) option = written("face-partitions", settings);
    if (quality.stabilize) option = written("stabilize", settings);
    if (!option.empty())
        throw UsageError{
            "--light-at and " + option + " contradict each other: a lamp's maps are the faces of a cube about it"};
}

/// Throws UsageError if a point light is requested together with an option that supports only directional lights.
void requireNoneIfPoint(const Settings& settings) {
    if (!settings.lightAt) return;
    const plan::Quality& quality = settings.quality;
    requireCubeMaps(settings);
    if (quality.look.ground)
        throw UsageError{"--ground and --light-at contradict each other: the ground shows the shadow of a direction"};
}

} // namespace

bool isFramed(const Settings& settings) {
    return settings.cameraFile.empty() && !settings.eye;
}

plan::View viewOf(
    const Settings& settings, const hierarchy::ModelSummary& summary, std::span<const glm::dvec3> outline) {
    requireOneCamera(settings);
    plan::View view;
    view.width = settings.imageSize[0];
    view.height = settings.imageSize[1];
    view.up = settings.up.value_or(kAutoUp);
    if (view.up == kAutoUp) view.up = summary.up.direction;
    view.pointLight = pointLightOf(settings, summary);
    view.towardsLight = view.pointLight ? towardsPoint(*view.pointLight, hierarchy::mainPartOf(summary), view.up)
                                        : lightOf(settings, view.up);
    view.sunAngleRadians = lightDiameter(settings);
    setSections(settings, view);
    if (!settings.cameraFile.empty()) {
        view.camera = path::readCamera(settings.cameraFile);
        view.camera.projection = settings.projection.value_or(view.camera.projection);
        return view;
    }
    const double fovY = radiansFromDegrees(settings.fovYDegrees.value_or(kUsualFovYDegrees));
    const path::Vantage vantage = path::vantageOf(settings.side, view.up);
    const std::vector<glm::dvec3> corners = path::cornersOf(hierarchy::mainPartOf(summary));
    const auto frame =
        settings.projection == Projection::Orthographic ? path::orthographicFraming : path::framingCamera;
    view.camera = frame(outline.empty() ? corners : outline, vantage, view.aspect(), fovY);
    if (settings.eye || settings.target) {
        view.camera.eye = settings.eye.value_or(view.camera.eye);
        view.camera.target = settings.target.value_or(0.5 * (corners.front() + corners.back()));
    }
    if (view.camera.eye == view.camera.target) throw UsageError{"--eye and --target are the same point"};
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
        throw UsageError{"--light-at and " + option + " contradict each other: it is of a light that is a direction"};
}

Settings uprightIn(const Settings& settings, const hierarchy::ModelFile& model) {
    Settings upright = settings;
    if (settings.up == kAutoUp) upright.up = path::guessedUp(model).up.direction;
    return upright;
}

plan::View viewOf(const Settings& settings, const hierarchy::ModelFile& model) {
    const std::vector<glm::dvec3> outline = isFramed(settings) ? path::outlineOf(model) : std::vector<glm::dvec3>();
    return viewOf(uprightIn(settings, model), model.summary(), outline);
}

plan::Quality qualityOf(const Settings& settings) {
    plan::Quality quality = settings.quality;
    quality.warp = warpOf(settings);
    if (quality.near && quality.far && !(*quality.near < *quality.far))
        throw UsageError{"--near and --far contradict each other: near must be below far"};
    requireNoWarpIfStable(settings);
    requireCapable(settings);
    requireSunIfShadowed(settings);
    requireNoneIfPoint(settings);
    if (settings.lightAt && quality.look.shading == plan::Shading::Auto) quality.look.shading = plan::Shading::Lit;
    return quality;
}

void requireMapsFor(const std::string& option, const SettingTexts& texts) {
    const auto shadows = texts.find("shadows");
    if (shadows != texts.end() && shadows->second == wordOf(plan::kShadowModes, plan::ShadowMode::Exact))
        throw UsageError{"--shadows exact and " + option + " contradict each other: exact shadows have no maps"};
}

Settings settingsOf(const SettingTexts& texts, bool withSwept) {
    std::size_t known = 0;
    for (const Setting& setting : table()) {
        if (!texts.contains(setting.name())) continue;
        ++known;
        if (setting.description().isOfMaps) requireMapsFor(setting.option(), texts);
    }
    if (known != texts.size()) // an unknown name is reported before invalid values
        for (const auto& given : texts)
            if (std::none_of(
                    table().begin(), table().end(), [&](const Setting& each) { return each.name() == given.first; })) {
                refuseRemovedOption("--" + given.first);
                throw UsageError{"--" + given.first + ": there is no such option"};
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
