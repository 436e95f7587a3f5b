// The commands and options of a program as plain values, for manual pages and completions. They are read from the
// parser that also prints --help.
#pragma once

#include "settings/help_table.h"

#include <string>
#include <vector>

namespace CLI { // NOLINT(readability-identifier-naming): the name is that of the library CLI11
class App;
}

namespace gnomon::manual {

/// Marks an option (CLI::Option::option_text) that its command requires unless a subcommand follows. The command itself
/// checks it: CLI11 takes the name of a subcommand for the value of a required argument.
inline constexpr const char* kRequiredWithoutSubcommand = "REQUIRED";

/// An option or a positional argument.
struct OptionWords {
    // Names of an option such as "-o" and "--output", without old names. A positional argument has one name.
    std::vector<std::string> names;
    std::string value;                // placeholder of its value: "TEXT", "INT"; empty for a flag
    std::vector<std::string> choices; // the allowed values, if there is a short list
    std::string byDefault;
    std::string description;
    bool isRequired = false;
    bool isRepeated = false; // takes several values: INPUT...
    settings::HelpPlace place{settings::Group::Input, settings::Tier::Everyday, 0};
};

/// A command with its options and subcommands. The program itself is the command with an empty path.
struct CommandWords {
    std::vector<std::string> path; // for example {"sun", "hours"}
    std::string description;
    std::string notes;                  // text after the options
    std::vector<OptionWords> arguments; // positional arguments
    std::vector<OptionWords> options;   // in the order of settings::helpTable()
    std::vector<CommandWords> commands;
};

/// Returns the commands and options of `program`, except hidden ones and old names. `program` can also be a subcommand.
CommandWords commandWords(const CLI::App& program);

/// Returns the subcommand of `program` with the words `path`. Throws Error if there is none.
const CommandWords& commandAt(const CommandWords& program, const std::vector<std::string>& path);

/// Returns `first` and the words of the command's path, joined by `between`. Examples are "gnomon sun hours" and
/// "_gnomon_sun_hours".
std::string joinedPath(const CommandWords& command, const std::string& first, const std::string& between);

} // namespace gnomon::manual
