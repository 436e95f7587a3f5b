// What a command line can say, as plain values: read off the table that also parses it and prints --help.
#pragma once

#include <string>
#include <vector>

namespace CLI { // NOLINT(readability-identifier-naming): the library's
class App;
}

namespace gnomon::manual {

/// An option, or what is given by its place.
struct OptionWords {
    std::vector<std::string> names;   // "-o", "--output"; the one name of what is given by its place
    std::string value;                // what stands for its value: "TEXT", "INT"; empty for a flag
    std::vector<std::string> choices; // the values it may have, where they are few
    std::string byDefault;
    std::string description;
    bool isRequired = false;
};

/// A command with those below it. The program itself has no path.
struct CommandWords {
    std::vector<std::string> path; // {"sun", "hours"}
    std::string description;
    std::vector<OptionWords> arguments; // by their places
    std::vector<OptionWords> options;
    std::vector<CommandWords> commands;
};

/// Of `program`, without what it hides from --help.
CommandWords commandWords(const CLI::App& program);

/// The command of `program` that `path` leads to. Throws Error if there is none.
const CommandWords& commandAt(const CommandWords& program, const std::vector<std::string>& path);

/// `command`'s path with a word before and `between` each two, for "gnomon sun hours" and "_gnomon_sun_hours".
std::string joinedPath(const CommandWords& command, const std::string& first, const std::string& between);

} // namespace gnomon::manual
