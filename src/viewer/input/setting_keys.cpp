#include "viewer/input/setting_keys.h"

namespace gnomon::viewer {

bool changeShown(Action action, int value, ViewSettings& settings) {
    switch (action) {
    case Action::ToggleHelp:
        settings.showsHelp = !settings.showsHelp;
        return true;
    case Action::TogglePanel:
        settings.showsPanel = !settings.showsPanel;
        return true;
    case Action::ToggleFacts:
        settings.showsFacts = !settings.showsFacts;
        return true;
    case Action::SetOverlay:
        settings.overlay = overlayNames()[static_cast<std::size_t>(value)].overlay;
        return true;
    default:
        return false;
    }
}

std::optional<std::string> changeQuality(Action action, int value, plan::Quality& quality) {
    switch (action) {
    case Action::StepScheme:
        return stepScheme(quality, value);
    case Action::StepWarp:
        return stepWarp(quality, value);
    case Action::StepSlices:
        return stepSlices(quality, value);
    case Action::StepFaces:
        return stepFaces(quality);
    case Action::StepTexels:
        return stepTexels(quality, value);
    case Action::StepFilter:
        return stepFilter(quality);
    case Action::StepDetail:
        return stepDetail(quality, value);
    case Action::ToggleCulling:
        return toggleCulling(quality);
    case Action::ToggleStabilising:
        return toggleStabilising(quality);
    default:
        return std::nullopt;
    }
}

} // namespace gnomon::viewer
