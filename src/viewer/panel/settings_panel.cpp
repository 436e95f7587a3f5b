#include "viewer/panel/settings_panel.h"

#include "settings/step.h"
#include "settings/table.h"
#include "viewer/panel/light_widget.h"
#include "viewer/scene.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include <imgui/imgui.h>

namespace gnomon::viewer {

namespace {

using settings::Setting;

/// Draws a combo box that offers `count` names. Returns true if the user chose another name.
template <class NameOf>
bool chooseFrom(const char* label, int count, int& current, const NameOf& nameOf) {
    bool hasChanged = false;
    if (ImGui::BeginCombo(label, current >= 0 && current < count ? nameOf(current) : "")) {
        for (int i = 0; i < count; ++i)
            if (ImGui::Selectable(nameOf(i), i == current) && i != current) {
                current = i;
                hasChanged = true;
            }
        ImGui::EndCombo();
    }
    return hasChanged;
}

bool drawScheme(plan::Quality& quality) {
    int scheme = static_cast<int>(schemeOf(quality));
    const auto nameOf = [](int i) { return name(kSchemes[static_cast<std::size_t>(i)]); };
    if (!chooseFrom("scheme", static_cast<int>(kSchemes.size()), scheme, nameOf)) return false;
    choose(kSchemes[static_cast<std::size_t>(scheme)], quality);
    return true;
}

bool drawWords(const Setting& setting, settings::Settings& settings) {
    const std::vector<std::string>& words = setting.words();
    int current = static_cast<int>(std::find(words.begin(), words.end(), setting.text(settings)) - words.begin());
    const auto nameOf = [&](int i) { return words[static_cast<std::size_t>(i)].c_str(); };
    const char* title = setting.description().offer.title.c_str();
    if (!chooseFrom(title, static_cast<int>(words.size()), current, nameOf)) return false;
    setting.set(settings, setting.parse(words[static_cast<std::size_t>(current)]));
    return true;
}

bool drawSwitch(const Setting& setting, settings::Settings& settings) {
    bool isOn = std::any_cast<bool>(setting.value(settings));
    if (!ImGui::Checkbox(setting.description().offer.title.c_str(), &isOn)) return false;
    setting.set(settings, isOn);
    return true;
}

/// Draws a slider for an integer setting over its range. Returns true if the user changed `value`.
bool slide(const settings::Offer& offer, int& value) {
    return ImGui::SliderInt(offer.title.c_str(), &value, static_cast<int>(offer.min), static_cast<int>(offer.max));
}

bool drawWhole(const Setting& setting, settings::Settings& settings) {
    int value = std::any_cast<int>(setting.value(settings));
    if (!slide(setting.description().offer, value)) return false;
    setting.set(settings, value);
    return true;
}

bool drawWholeOrAuto(const Setting& setting, settings::Settings& settings) {
    const settings::Offer& offer = setting.description().offer;
    auto value = std::any_cast<std::optional<int>>(setting.value(settings));
    bool isAuto = !value;
    bool hasChanged = ImGui::Checkbox(("as many " + offer.title + " as the aliasing bound needs").c_str(), &isAuto);
    if (hasChanged)
        settings::step(setting, settings, 0);
    else if (value && slide(offer, *value)) {
        setting.set(settings, value);
        hasChanged = true;
    }
    return hasChanged;
}

bool drawNumber(const Setting& setting, settings::Settings& settings) {
    const settings::Offer& offer = setting.description().offer;
    auto value = static_cast<float>(std::any_cast<double>(setting.value(settings)));
    const auto min = static_cast<float>(offer.min);
    const auto max = static_cast<float>(offer.max);
    if (!ImGui::SliderFloat(offer.title.c_str(), &value, min, max, "%.2f", ImGuiSliderFlags_Logarithmic)) return false;
    setting.set(settings, std::clamp(static_cast<double>(value), offer.min, offer.max));
    return true;
}

bool drawSize(const Setting& setting, settings::Settings& settings) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(settings::inWords(setting, settings).c_str());
    ImGui::SameLine();
    const int halved = ImGui::SmallButton("half") ? -1 : 0;
    ImGui::SameLine();
    const int steps = ImGui::SmallButton("twice") ? 1 : halved;
    if (steps != 0) settings::step(setting, settings, steps);
    return steps != 0;
}

bool drawSetting(const Setting& setting, settings::Settings& settings) {
    switch (setting.kind()) {
    case settings::Kind::Words:
        return drawWords(setting, settings);
    case settings::Kind::Switch:
        return drawSwitch(setting, settings);
    case settings::Kind::Whole:
        return drawWhole(setting, settings);
    case settings::Kind::WholeOrAuto:
        return drawWholeOrAuto(setting, settings);
    case settings::Kind::Number:
        return drawNumber(setting, settings);
    case settings::Kind::Size:
        return drawSize(setting, settings);
    case settings::Kind::Other:
        return false;
    }
    return false;
}

bool drawQuality(settings::Settings& settings) {
    bool hasChanged = drawScheme(settings.quality);
    for (const Setting& setting : settings::table())
        if (!setting.description().offer.title.empty() && drawSetting(setting, settings)) {
            if (settings::asksForMaps(setting)) settings::askForMaps(settings);
            hasChanged = true;
        }
    return hasChanged;
}

/// Draws the controls for the range of the colour map. It is either the range of the model's values, or a range that
/// the user drags.
bool drawEnds(const Scene& scene, settings::ValueColors& colors) {
    bool isOwn = colors.range.has_value();
    const bool isToggled = ImGui::Checkbox("ends of one's own", &isOwn);
    if (isToggled) colors.range.reset();
    const auto widest = widestEnds(colors, scene.model().summary(), scene.frame()->plan.view.up);
    if (isToggled && isOwn) colors.range = widest;
    if (!colors.range) return isToggled;
    auto min = static_cast<float>((*colors.range)[0]);
    auto max = static_cast<float>((*colors.range)[1]);
    const auto speed = static_cast<float>((widest[1] - widest[0]) / 500);
    if (!ImGui::DragFloatRange2("ends", &min, &max, speed, 0, 0, "%.4g") || !(min < max)) return isToggled;
    colors.range = {double{min}, double{max}};
    return true;
}

/// Draws the controls with which the user chooses the surface colours and the colour map.
bool drawColors(const Scene& scene, ViewSettings& settings) {
    const std::vector<settings::ValueColors> choices = colorChoices(scene.model().summary(), scene.capabilities());
    std::vector<std::string> names;
    names.reserve(choices.size());
    int current = 0;
    for (const settings::ValueColors& choice : choices) {
        if (isAmong(std::span(&choice, 1), settings.colors)) current = static_cast<int>(names.size());
        names.push_back(nameOf(choice));
    }
    int chosen = current;
    const auto shown = [&](int i) { return names[static_cast<std::size_t>(i)].c_str(); };
    bool hasChanged = chooseFrom("colours", static_cast<int>(names.size()), chosen, shown);
    if (hasChanged) {
        stepColors(choices, chosen - current, settings.colors);
        settings.overlay = render::Overlay::None;
    }
    using settings::ColorBy;
    if (settings.colors.by == ColorBy::None || settings.colors.by == ColorBy::Vertex) return hasChanged;
    int map = static_cast<int>(settings.colors.map);
    const auto mapName = [](int i) { return plan::kColorMaps.at(static_cast<std::size_t>(i)).word; };
    if (chooseFrom("colour map", static_cast<int>(plan::kColorMaps.size()), map, mapName)) {
        settings.colors.map = plan::kColorMaps.at(static_cast<std::size_t>(map)).value;
        hasChanged = true;
    }
    return drawEnds(scene, settings.colors) || hasChanged;
}

bool drawViewSettings(const OverlayContent& content, ViewSettings& settings, OverlayAnswer& answer) {
    bool hasChanged = false;
    const auto& overlays = render::kOverlays;
    int overlay = 0;
    for (std::size_t i = 0; i < overlays.size(); ++i)
        if (overlays[i].value == settings.overlay) overlay = static_cast<int>(i);
    if (chooseFrom("overlay", static_cast<int>(overlays.size()), overlay, [&](int i) {
            return overlays[static_cast<std::size_t>(i)].title;
        })) {
        settings.overlay = overlays[static_cast<std::size_t>(overlay)].value;
        hasChanged = true;
    }
    hasChanged |= drawColors(*content.scene, settings);
    auto target = static_cast<float>(settings.targetMs);
    if (ImGui::SliderFloat("target ms", &target, 0, 200, target > 0 ? "%.0f" : "none")) {
        settings.targetMs = target < 1 ? 0 : static_cast<double>(target);
        hasChanged = true;
    }
    const auto button = [&](const char* label, Action action) {
        if (ImGui::Button(label)) answer.actions.push_back(action);
        ImGui::SameLine();
    };
    button(content.isFrozen ? "thaw" : "freeze culling", Action::Freeze);
    button(content.isRecording ? "end recording" : "record", Action::Record);
    button(content.playedPart >= 0 ? "stop" : "play", Action::Play);
    button("picture", Action::Screenshot);
    ImGui::NewLine();
    return hasChanged;
}

} // namespace

OverlayAnswer drawPanel(const OverlayContent& content, ViewSettings& settings, TexelPlot& plot) {
    OverlayAnswer answer;
    const float unit = ImGui::GetFontSize();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x - 0.5F * unit, 0.5F * unit}, ImGuiCond_Always, {1, 0});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {screen.x, std::max(screen.y - unit, 1.0F)});
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                        ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                                        ImGuiWindowFlags_NoNav;
    if (ImGui::Begin("settings (Tab)", &settings.showsPanel, kFlags)) {
        ImGui::PushItemWidth(11 * unit);
        answer.hasChanged |= drawQuality(settings.asked);
        answer.hasChanged |= drawViewSettings(content, settings, answer);
        ImGui::Separator();
        if (drawLightWidget(content.scene->frame(), content.camera, plot, settings.asked.towardsLight)) {
            answer.hasChanged = settings.asked.isLightGiven = true;
            settings.asked.lightAt = std::nullopt;
            settings.asked.sun = std::nullopt;
            settings.asked.north = std::nullopt;
        }
        answer.isUnfinished = !plot.isComplete();
        ImGui::PopItemWidth();
    }
    ImGui::End();
    return answer;
}

} // namespace gnomon::viewer
