#include "viewer/input/key_table.h"

#include "path/framing.h"
#include "render/backend.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace gnomon::viewer {

namespace {

constexpr int of(Way way) {
    return static_cast<int>(way);
}

constexpr int of(path::ViewSide side) {
    return static_cast<int>(side);
}

/// The number of overlays that have a key, F1 to F8. There may be more overlays.
constexpr std::size_t kOverlayKeys = std::min<std::size_t>(8, render::kOverlays.size());

std::vector<Binding> cameraAndSettingKeys() {
    return {
        Binding{GLFW_KEY_W, false, Action::Fly, of(Way::Forward), "W", "fly forward; Shift faster, Ctrl slower"},
        Binding{GLFW_KEY_S, false, Action::Fly, of(Way::Back), "S", "fly back"},
        Binding{GLFW_KEY_A, false, Action::Fly, of(Way::Left), "A", "fly left"},
        Binding{GLFW_KEY_D, false, Action::Fly, of(Way::Right), "D", "fly right"},
        Binding{GLFW_KEY_Q, false, Action::Fly, of(Way::Down), "Q", "fly down"},
        Binding{GLFW_KEY_E, false, Action::Fly, of(Way::Up), "E", "fly up"},
        Binding{GLFW_KEY_SPACE, false, Action::Focus, 0, "Space", "look at what is under the cursor, nearer"},
        Binding{GLFW_KEY_1, false, Action::LookFrom, of(path::ViewSide::Front), "1", "view from the front"},
        Binding{GLFW_KEY_2, false, Action::LookFrom, of(path::ViewSide::Back), "2", "from the back"},
        Binding{GLFW_KEY_3, false, Action::LookFrom, of(path::ViewSide::Left), "3", "from the left"},
        Binding{GLFW_KEY_4, false, Action::LookFrom, of(path::ViewSide::Right), "4", "from the right"},
        Binding{GLFW_KEY_5, false, Action::LookFrom, of(path::ViewSide::Top), "5", "from above"},
        Binding{GLFW_KEY_6, false, Action::LookFrom, of(path::ViewSide::Bottom), "6", "from below"},
        Binding{GLFW_KEY_LEFT, false, Action::RecentView, -1, "Left", "the view before, of those at which you stayed"},
        Binding{GLFW_KEY_RIGHT, false, Action::RecentView, 1, "Right", "the view behind it"},
        Binding{GLFW_KEY_O, false, Action::ToggleProjection, 0, "O", "orthographic or perspective"},
        Binding{GLFW_KEY_HOME, false, Action::GoHome, 0, "Home", "back to the start"},
        Binding{GLFW_KEY_N, false, Action::StepScheme, 1, "N", "next scheme: none, one map, slices, faces, rays"},
        Binding{GLFW_KEY_N, true, Action::StepScheme, -1, "Shift+N", "previous scheme"},
        Binding{GLFW_KEY_X, false, Action::StepSetting, 1, "X", "next warp", "warp"},
        Binding{GLFW_KEY_X, true, Action::StepSetting, -1, "Shift+X", "previous warp", "warp"},
        Binding{GLFW_KEY_RIGHT_BRACKET, false, Action::StepSetting, 1, "]", "one slice more", "z-partitions"},
        Binding{GLFW_KEY_LEFT_BRACKET, false, Action::StepSetting, -1, "[", "one slice fewer", "z-partitions"},
        Binding{
            GLFW_KEY_Z,
            false,
            Action::StepSetting,
            0,
            "Z",
            "slices: as the aliasing bound needs, or four",
            "z-partitions"},
        Binding{GLFW_KEY_F, false, Action::StepSetting, 1, "F", "face partitions: off, on, auto", "face-partitions"},
        Binding{GLFW_KEY_T, false, Action::StepSetting, 1, "T", "twice the shadow texels", "shadow-texels"},
        Binding{GLFW_KEY_T, true, Action::StepSetting, -1, "Shift+T", "half the shadow texels", "shadow-texels"},
        Binding{GLFW_KEY_K, false, Action::StepSetting, 1, "K", "filter kernel: none, 2, 3, 5 texels", "filter"},
        Binding{GLFW_KEY_PERIOD, false, Action::StepSetting, -1, ".", "finer level of detail", "error-pixels"},
        Binding{GLFW_KEY_COMMA, false, Action::StepSetting, 1, ",", "coarser level of detail", "error-pixels"},
        Binding{GLFW_KEY_C, false, Action::StepSetting, 1, "C", "cull casters per partition", "cull-casters"},
        Binding{GLFW_KEY_B, false, Action::StepSetting, 1, "B", "stabilised slices", "stabilize"},
        Binding{GLFW_KEY_V, false, Action::Freeze, 0, "V", "freeze the culling camera, seen from outside"},
        Binding{GLFW_KEY_M, false, Action::ToggleTarget, 0, "M", "hold a time target (that asked for, or 33 ms)"},
    };
}

std::vector<Binding> overlayKeys() {
    std::vector<Binding> keys;
    for (std::size_t i = 0; i < kOverlayKeys; ++i) {
        const bool isNone = render::kOverlays[i].value == render::Overlay::None;
        const std::string help = isNone ? "no overlay" : std::string("overlay: ") + render::kOverlays[i].title;
        const int index = static_cast<int>(i);
        keys.push_back({GLFW_KEY_F1 + index, false, Action::SetOverlay, index, "F" + std::to_string(i + 1), help});
    }
    return keys;
}

std::vector<Binding> windowKeys() {
    return {
        Binding{
            GLFW_KEY_Y, false, Action::StepColors, 1, "Y", "colours by value: stored, height, slope, error, fields"},
        Binding{GLFW_KEY_Y, true, Action::StepColors, -1, "Shift+Y", "colours by the value before"},
        Binding{GLFW_KEY_TAB, false, Action::TogglePanel, 0, "Tab", "panel of settings"},
        Binding{GLFW_KEY_G, false, Action::ToggleFacts, 0, "G", "graph and figures, or a line"},
        Binding{GLFW_KEY_L, false, Action::ToggleEyeDome, 0, "L", "dark hollows and outlines, by depth alone"},
        Binding{GLFW_KEY_H, false, Action::ToggleHelp, 0, "H", "this help"},
        Binding{GLFW_KEY_R, false, Action::Record, 0, "R", "record a path; again saves it"},
        Binding{GLFW_KEY_P, false, Action::Play, 0, "P", "play the last path; again stops"},
        Binding{GLFW_KEY_J, false, Action::ToggleSection, 0, "J", "level section: cut off what is above; again: none"},
        Binding{GLFW_KEY_J, true, Action::ToggleSection, 1, "Shift+J", "a box of six sections around the model"},
        Binding{GLFW_KEY_PAGE_UP, false, Action::MoveSection, 8, "PageUp", "section upwards; with Shift a little"},
        Binding{GLFW_KEY_PAGE_UP, true, Action::MoveSection, 1, "Shift+PageUp", "section a little upwards"},
        Binding{GLFW_KEY_PAGE_DOWN, false, Action::MoveSection, -8, "PageDown", "section downwards"},
        Binding{GLFW_KEY_PAGE_DOWN, true, Action::MoveSection, -1, "Shift+PageDown", "section a little downwards"},
        Binding{
            GLFW_KEY_I, false, Action::SaveCamera, 0, "I", "save the camera as JSON, for pictures without the window"},
        Binding{
            GLFW_KEY_U, false, Action::Measure, 0, "U", "measure: a click is a point, Shift+click the nearest vertex"},
        Binding{GLFW_KEY_BACKSPACE, false, Action::DropPoint, 0, "Backspace", "drop the last point measured"},
        Binding{GLFW_KEY_ENTER, false, Action::NextMeasure, 0, "Enter", "begin another measure"},
        Binding{
            GLFW_KEY_U, true, Action::SaveMeasures, 0, "Shift+U", "save the measures, JSON and CSV beside the model"},
        Binding{GLFW_KEY_F9, false, Action::Reload, 0, "F9", "open the model again"},
        Binding{GLFW_KEY_F12, false, Action::Screenshot, 0, "F12", "save the picture"},
        Binding{GLFW_KEY_F12, true, Action::Screenshot, 1, "Shift+F12", "save the window with its overlays"},
        Binding{GLFW_KEY_ESCAPE, false, Action::Leave, 0, "Esc", "leave"},
    };
}

constexpr std::array kMouseUses{
    MouseUse{"drag", "orbit what is under the cursor"},
    MouseUse{"middle or Shift + drag", "move sideways"},
    MouseUse{"right drag", "look around"},
    MouseUse{"Ctrl + drag", "turn the light"},
    MouseUse{"Ctrl + Shift + drag", "move the section under the cursor"},
    MouseUse{"wheel", "towards what is under the cursor"},
    MouseUse{"Ctrl + wheel", "flying speed"},
    MouseUse{"double click", "look at what is under the cursor"},
    MouseUse{"drop a file", "open a .gnm, or build a mesh and open it"},
};

} // namespace

std::span<const Binding> bindings() {
    static const std::vector<Binding> all = [] {
        std::vector<Binding> keys = cameraAndSettingKeys();
        for (const auto& more : {overlayKeys(), windowKeys()})
            keys.insert(keys.end(), more.begin(), more.end());
        return keys;
    }();
    return all;
}

std::span<const MouseUse> mouseUses() {
    return kMouseUses;
}

std::string keysForPeople() {
    std::string text = "Keys:\n";
    const auto add = [&](std::string name, const std::string& help) {
        name.resize(std::max<std::size_t>(name.size() + 2, 14), ' ');
        text += "  " + name + help + "\n";
    };
    for (const Binding& binding : bindings())
        add(binding.keyName, binding.help);
    text += "Mouse:\n";
    for (const MouseUse& use : mouseUses())
        add(use.gesture, use.help);
    return text;
}

const Binding* bindingOf(int key, bool withShift) {
    const Binding* plain = nullptr;
    for (const Binding& binding : bindings()) {
        if (binding.key != key) continue;
        if (binding.withShift == withShift) return &binding;
        if (!binding.withShift) plain = &binding;
    }
    return plain;
}

} // namespace gnomon::viewer
