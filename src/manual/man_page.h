// Generates manual pages from the commands and options of a program.
#pragma once

#include "manual/command_words.h"

namespace gnomon::manual {

/// Returns the manual page of `command` of the program `program`, in roff with the macros of man(7), for section 1 of
/// the manual. The footer shows `version`.
std::string manPage(const CommandWords& command, const std::string& program, const std::string& version);

} // namespace gnomon::manual
