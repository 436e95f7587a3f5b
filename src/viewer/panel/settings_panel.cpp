#include "viewer/panel/settings_panel.h"

#include "settings/view_options.h"
#include "viewer/panel/light_pad.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <imgui/imgui.h>

namespace gnomon::viewer {

namespace {

/// A combo over `count` names; true if another was chosen.
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

bool drawSchemeSettings(plan::Quality& quality) {
    bool hasChanged = false;
    int scheme = static_cast<int>(schemeOf(quality));
    if (chooseFrom("scheme", static_cast<int>(kSchemes.size()), scheme, [](int i) {
            return name(kSchemes[static_cast<std::size_t>(i)]);
        })) {
        choose(kSchemes[static_cast<std::size_t>(scheme)], quality);
        hasChanged = true;
    }
    const auto rules = warpRules();
    int warp = static_cast<int>(std::find(rules.begin(), rules.end(), quality.warp.rule) - rules.begin());
    std::vector<std::string> names;
    for (const shadow::WarpRule rule : rules)
        names.push_back(plan::warpName({rule}));
    if (chooseFrom("warp", static_cast<int>(rules.size()), warp, [&](int i) {
            return names[static_cast<std::size_t>(i)].c_str();
        })) {
        quality.warp.rule = rules[static_cast<std::size_t>(warp)];
        hasChanged = true;
    }
    bool isAuto = !quality.zPartitions;
    if (ImGui::Checkbox("as many slices as the promise needs", &isAuto)) {
        stepSlices(quality, 0);
        hasChanged = true;
    }
    if (quality.zPartitions) {
        int slices = *quality.zPartitions;
        if (ImGui::SliderInt("slices", &slices, 1, settings::kMaxSlices)) {
            quality.zPartitions = slices;
            hasChanged = true;
        }
    }
    constexpr std::array kChoices = {"off", "on", "auto"};
    int faces = static_cast<int>(quality.facePartitions);
    if (chooseFrom("faces", 3, faces, [&](int i) { return kChoices[static_cast<std::size_t>(i)]; })) {
        quality.facePartitions = static_cast<plan::Choice>(faces);
        hasChanged = true;
    }
    return hasChanged;
}

bool drawTexelSettings(plan::Quality& quality) {
    bool hasChanged = false;
    const auto texels = std::to_string(quality.shadowTexelsWidth) + " x " + std::to_string(quality.shadowTexelsHeight);
    ImGui::AlignTextToFramePadding();
    ImGui::Text("texels %s", texels.c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("half")) {
        stepTexels(quality, -1);
        hasChanged = true;
    }
    ImGui::SameLine();
    if (ImGui::SmallButton("twice")) {
        stepTexels(quality, 1);
        hasChanged = true;
    }
    hasChanged |= ImGui::SliderInt("filter texels", &quality.filter, 0, 9);
    auto error = static_cast<float>(quality.errorPixels);
    if (ImGui::SliderFloat(
            "error pixels",
            &error,
            static_cast<float>(kLeastErrorPixels),
            static_cast<float>(kMostErrorPixels),
            "%.2f",
            ImGuiSliderFlags_Logarithmic)) {
        quality.errorPixels = std::clamp(static_cast<double>(error), kLeastErrorPixels, kMostErrorPixels);
        hasChanged = true;
    }
    hasChanged |= ImGui::Checkbox("cull casters", &quality.cullCasters);
    ImGui::SameLine();
    hasChanged |= ImGui::Checkbox("stabilise", &quality.stabilize);
    return hasChanged;
}

bool drawViewSettings(const OverlayContent& content, ViewSettings& settings, OverlayAnswer& answer) {
    bool hasChanged = false;
    const auto overlays = overlayNames();
    int overlay = 0;
    for (std::size_t i = 0; i < overlays.size(); ++i)
        if (overlays[i].overlay == settings.overlay) overlay = static_cast<int>(i);
    if (chooseFrom("overlay", static_cast<int>(overlays.size()), overlay, [&](int i) {
            return overlays[static_cast<std::size_t>(i)].name;
        })) {
        settings.overlay = overlays[static_cast<std::size_t>(overlay)].overlay;
        hasChanged = true;
    }
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

OverlayAnswer drawPanel(const OverlayContent& content, ViewSettings& settings, StoragePad& pad) {
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
        answer.hasChanged |= drawSchemeSettings(settings.quality);
        answer.hasChanged |= drawTexelSettings(settings.quality);
        answer.hasChanged |= drawViewSettings(content, settings, answer);
        ImGui::Separator();
        answer.hasChanged |= drawLightPad(content.scene->frame(), content.camera, pad, settings.towardsLight);
        answer.isUnfinished = !pad.isComplete();
        ImGui::PopItemWidth();
    }
    ImGui::End();
    return answer;
}

} // namespace gnomon::viewer
