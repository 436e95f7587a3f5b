// Text from outside as it may reach a terminal, a window or a page: in one line, and each character is visible.
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace gnomon {

/// Returns `text` with characters that act on a terminal, turn the direction of writing or have no shape written as in
/// C: "\n", "\x1b". So are bytes that are not UTF-8. All other text stays as it is.
std::string printable(std::string_view text);

/// What an exception says, in the order of our own: "PATH: cannot create directories: No space left on device" where
/// the standard library has other words and another order.
std::string inWords(const std::exception& error);

} // namespace gnomon
