// Text from outside as it may reach a terminal: in one line and without control characters.
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace gnomon {

/// `text` with line breaks, escapes, other control characters (those that turn the direction of writing, too) and bytes
/// that are no UTF-8 written as in C: "\n", "\x1b". What is printable already stays as it is.
std::string printable(std::string_view text);

/// What an exception says, in the order of our own: "PATH: cannot create directories: No space left on device" where
/// the standard library has other words and another order.
std::string inWords(const std::exception& error);

} // namespace gnomon
