// Generates the texts of --help and --help-all from the description of the command line.
#pragma once

#include "manual/command_words.h"

namespace gnomon::app {

/// The max number of columns of a line of a help text.
inline constexpr std::size_t kHelpColumns = 100;

enum class HelpDetail : std::uint8_t { Everyday, All };

/// Returns the help text of `command`, whose full name is `name`, such as "gnomon sun hours". Everyday: one line per
/// everyday option, after the name of its group. All: all options with the titles of their groups, and the notes.
std::string helpText(const manual::CommandWords& command, const std::string& name, HelpDetail detail);

} // namespace gnomon::app
