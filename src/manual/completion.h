// What shells complete, from the words of the command line.
#pragma once

#include "manual/command_words.h"

namespace gnomon::manual {

/// Functions for the completion of `gnomon` by bash, by zsh (a file `_gnomon` of its fpath) and by fish.
std::string bashCompletion(const CommandWords& program);
std::string zshCompletion(const CommandWords& program);
std::string fishCompletion(const CommandWords& program);

} // namespace gnomon::manual
