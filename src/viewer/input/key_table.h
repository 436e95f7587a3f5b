// The table of all keys of the window. It maps key presses to actions, and the help is generated from it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace gnomon::viewer {

/// The action that a key triggers. The `value` of the key's binding selects a variant or an amount.
enum class Action : std::uint8_t {
    Fly, // while the key is held; value is a Way
    Focus,
    LookFrom, // value is a path::ViewSide
    ToggleProjection,
    GoHome,
    StepScheme,
    StepSetting, // value is the number of steps; the binding names the setting
    ToggleTarget,
    StepColors, // value is the number of steps through the values that colour the model
    SetOverlay, // value is an index of render::kOverlays
    Freeze,
    TogglePanel,
    ToggleFacts,
    ToggleHelp,
    ToggleEyeDome,
    Record,
    Play,
    ToggleSection, // value 1: a box of six sections
    MoveSection,   // value is the distance in 400ths of the model's height
    SaveCamera,
    Measure,
    NextMeasure,
    DropPoint,
    SaveMeasures,
    RecentView, // value -1: the previous view; 1: the next view
    Screenshot, // value 1: including the overlay
    Reload,
    Leave,
};

/// The directions of flight.
enum class Way : std::uint8_t { Forward, Back, Left, Right, Down, Up };

/// Binds a key, with or without Shift, to an action.
struct Binding {
    int key = 0; // key code of GLFW
    bool withShift = false;
    Action action = Action::Leave;
    int value = 0;
    std::string keyName{};
    std::string help{};
    std::string setting{}; // for StepSetting: a name in the table of settings
};

/// Returns all key bindings in the order of the help.
std::span<const Binding> bindings();

/// A mouse gesture and its effect, as the help shows them.
struct MouseUse {
    const char* gesture;
    const char* help;
};

/// Returns all mouse gestures in the order of the help.
std::span<const MouseUse> mouseUses();

/// Returns the help text of the window: all key bindings and mouse gestures, one per line.
std::string keysForPeople();

/// Returns the binding of `key`. If there is no binding with Shift, returns the binding without Shift, because Shift
/// also makes flights faster.
const Binding* bindingOf(int key, bool withShift);

} // namespace gnomon::viewer
