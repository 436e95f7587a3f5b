// Manual pages, from the words of the command line.
#pragma once

#include "manual/command_words.h"

namespace gnomon::manual {

/// The page of `command` of `program` in roff with the macros of man(7), section 1; `version` as it stands at the foot.
std::string manPage(const CommandWords& command, const std::string& program, const std::string& version);

} // namespace gnomon::manual
