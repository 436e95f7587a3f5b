// Text from outside as it may reach a terminal: in one line and without control characters.
#pragma once

#include <string>
#include <string_view>

namespace gnomon {

/// `text` with line breaks, escapes, other control characters (those that turn the direction of writing, too) and bytes
/// that are no UTF-8 written as in C: "\n", "\x1b". What is printable already stays as it is.
std::string printable(std::string_view text);

} // namespace gnomon
