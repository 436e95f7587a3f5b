// Shell completions, generated from the commands and options of a command line.
#pragma once

#include "manual/command_words.h"

namespace gnomon::manual {

/// Return completion scripts of `gnomon` for bash, zsh (a file `_gnomon` in its fpath) and fish.
std::string bashCompletion(const CommandWords& program);
std::string zshCompletion(const CommandWords& program);
std::string fishCompletion(const CommandWords& program);

} // namespace gnomon::manual
