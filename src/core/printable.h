// Makes external text safe for terminals, windows and pages. The result is one line of visible characters.
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace gnomon {

/// Returns `text` with harmful characters replaced by escapes as in C ("\n", "\x1b"). They are control characters,
/// bidirectional controls, invisible characters and bytes that are not UTF-8. All other text is unchanged.
std::string printable(std::string_view text);

/// Returns the message of the exception `error`. Errors of std::filesystem get the format of gnomon::Error: "PATH:
/// cannot create directories: No space left on device".
std::string inWords(const std::exception& error);

} // namespace gnomon
