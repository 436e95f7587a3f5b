// Generates completion scripts for shells from the commands and options of a program.
#pragma once

#include "manual/command_words.h"

namespace gnomon::manual {

/// Return the completion script of `gnomon` for bash, for zsh (a file `_gnomon` in its fpath), or for fish.
std::string bashCompletion(const CommandWords& program);
std::string zshCompletion(const CommandWords& program);
std::string fishCompletion(const CommandWords& program);

} // namespace gnomon::manual
