#include "viewer/input/setting_keys.h"

#include "settings/step.h"
#include "settings/table.h"

namespace gnomon::viewer {

bool changeShown(const Binding& binding, ViewSettings& settings) {
    switch (binding.action) {
    case Action::ToggleHelp:
        settings.showsHelp = !settings.showsHelp;
        return true;
    case Action::ToggleHollows:
        settings.darkensHollows = !settings.darkensHollows;
        return true;
    case Action::TogglePanel:
        settings.showsPanel = !settings.showsPanel;
        return true;
    case Action::ToggleFacts:
        settings.showsFacts = !settings.showsFacts;
        return true;
    case Action::SetOverlay:
        settings.overlay = executor::kOverlays[static_cast<std::size_t>(binding.value)].value;
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

} // namespace gnomon::viewer
