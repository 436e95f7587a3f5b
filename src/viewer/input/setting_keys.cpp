#include "viewer/input/setting_keys.h"

#include "core/formatted.h"
#include "settings/step.h"
#include "settings/table.h"
#include "viewer/input/section_drag.h"

#include <algorithm>

namespace gnomon::viewer {

bool changeShown(const Binding& binding, ViewSettings& settings) {
    switch (binding.action) {
    case Action::ToggleHelp:
        settings.showsHelp = !settings.showsHelp;
        return true;
    case Action::ToggleEyeDome:
        settings.usesEyeDome = !settings.usesEyeDome;
        return true;
    case Action::TogglePanel:
        settings.showsPanel = !settings.showsPanel;
        return true;
    case Action::ToggleFacts:
        settings.showsFacts = !settings.showsFacts;
        return true;
    case Action::SetOverlay:
        settings.overlay = render::kOverlays[static_cast<std::size_t>(binding.value)].value;
        return true;
    default:
        return false;
    }
}

std::optional<std::string> changeQuality(const Binding& binding, settings::Settings& settings) {
    if (binding.action == Action::StepScheme) {
        stepScheme(settings.quality, binding.value);
        return std::string("scheme: ") + name(schemeOf(settings.quality));
    }
    if (binding.action != Action::StepSetting) return std::nullopt;
    const settings::Setting& setting = settings::named(binding.setting);
    settings::step(setting, settings, binding.value);
    if (settings::asksForMaps(setting)) settings::askForMaps(settings);
    return settings::inWords(setting, settings);
}

std::optional<std::string> changeSection(
    const Binding& binding, settings::Settings& settings, const Box& bounds, const glm::dvec3& up) {
    constexpr double kStepsOfHeight = 400;
    if (binding.action != Action::ToggleSection && binding.action != Action::MoveSection) return std::nullopt;
    std::vector<settings::Section>& sections = settings.sections;
    if (binding.action == Action::ToggleSection && !sections.empty()) {
        sections.clear();
        return "section: none";
    }
    if (binding.action == Action::ToggleSection && binding.value == 1) {
        sections = sectionBox(bounds);
        return "section: a box of six; Ctrl + Shift + drag moves its sides";
    }
    const glm::dvec3 axis = glm::normalize(up);
    const double height = glm::dot(glm::abs(axis), bounds.extent());
    if (sections.empty()) sections.push_back({bounds.center(), axis});
    if (binding.action == Action::MoveSection && sections.size() > 1) { // the most horizontal section
        const auto level = [&](const settings::Section& s) { return glm::dot(glm::normalize(s.normal), axis); };
        const auto top = std::max_element(
            sections.begin(), sections.end(), [&](const auto& a, const auto& b) { return level(a) < level(b); });
        std::swap(*top, sections.back());
    }
    settings::Section& moved = sections.back();
    if (binding.action == Action::MoveSection) moved.point += axis * (binding.value / kStepsOfHeight * height);
    const double above = glm::dot(axis, moved.point - bounds.center()) + 0.5 * height;
    return formatted("section: %.4g above the lowest point", above);
}

} // namespace gnomon::viewer
