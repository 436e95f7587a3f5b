// Every key of the window, declared once: the table that dispatches also makes the help.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace gnomon::viewer {

/// What a key does; `value` of its binding says which or how much.
enum class Action : std::uint8_t {
    Fly, // while it is held: value is a Way
    Focus,
    LookFrom, // value is a path::ViewSide
    ToggleProjection,
    GoHome,
    StepScheme,
    StepSetting, // value is how many steps, of the setting that the binding names
    ToggleTarget,
    StepColors, // value is how many steps, among what the model can be coloured by
    SetOverlay, // value is an index of executor::kOverlays
    Freeze,
    TogglePanel,
    ToggleFacts,
    ToggleHelp,
    ToggleHollows,
    Record,
    Play,
    ToggleSection, // value 1: six of them
    MoveSection,   // value is by how many 400ths of the model's height
    SaveCamera,
    Measure,
    NextMeasure,
    DropPoint,
    SaveMeasures,
    RecentView, // value is -1 for that before, 1 for that behind it
    Screenshot, // value 1: with what is drawn over it
    Reload,
    Leave,
};

/// The ways of flying.
enum class Way : std::uint8_t { Forward, Back, Left, Right, Down, Up };

/// A key, or a key with Shift, and what it does.
struct Binding {
    int key = 0; // GLFW's
    bool withShift = false;
    Action action = Action::Leave;
    int value = 0;
    std::string keyName{};
    std::string help{};
    std::string setting{}; // of StepSetting: a name in the table of settings
};

/// All of them, in the order of the help.
std::span<const Binding> bindings();

/// What the mouse does, for the help.
struct MouseUse {
    const char* gesture;
    const char* help;
};

std::span<const MouseUse> mouseUses();

/// Both in lines, for a help that is text.
std::string keysForPeople();

/// The binding of `key`. Where a key has none with Shift, the one without counts: Shift also hastens flights.
const Binding* bindingOf(int key, bool withShift);

} // namespace gnomon::viewer
