// The table of all options in the order of --help. It contains the group of each option, and the commands whose --help
// shows it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::settings {

/// The groups of options, in the order in which --help prints them. `Research` contains options for researchers of
/// shadow algorithms and of simplification.
enum class Group : std::uint8_t { Input, View, Light, Quality, Compare, Output, Program, Research };

/// The two names of an option group: `label` in --help, and `title` in --help-all and in manual pages.
struct GroupNames {
    Group group;
    const char* label;
    const char* title;
};

inline constexpr std::array kGroups = {
    GroupNames{Group::Input, "Input", "Input"},
    GroupNames{Group::View, "View", "View"},
    GroupNames{Group::Light, "Light", "Light and look"},
    GroupNames{Group::Quality, "Quality", "Quality"},
    GroupNames{Group::Compare, "Compare", "Comparison"},
    GroupNames{Group::Output, "Output", "Output"},
    GroupNames{Group::Program, "Program", "Program and machine"},
    GroupNames{Group::Research, "Research", "Research"},
};

/// Tells which help shows an option. Both --help and --help-all show an Everyday option. Only --help-all shows the
/// Other and Research options.
enum class Tier : std::uint8_t { Everyday, Other, Research };

/// A row of the table.
struct HelpRow {
    std::string_view option; // without dashes; after a command ("build up") the row is only for this command
    Group group;
    std::string_view everyday; // the commands whose --help shows the option, separated by blanks; "*": all commands
};

std::span<const HelpRow> helpTable();

/// The group and the position of an option in the help of a command.
struct HelpPlace {
    Group group;
    Tier tier;
    std::size_t rank; // index of the row; options of a smaller rank come first
};

/// Returns where the help of `command` shows `option` (without dashes). `command` is the last word of the command's
/// name, such as "hours". The table must have a row for the option.
HelpPlace helpPlace(std::string_view command, std::string_view option);

} // namespace gnomon::settings
