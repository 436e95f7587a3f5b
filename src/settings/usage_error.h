// What is wrong with how the program is used, as against what is wrong with the world.
#pragma once

#include <string>

namespace gnomon::settings {

/// A contradiction between options, or a value that one of them cannot take: exit code 2 with `message`.
struct UsageError {
    std::string message;
};

/// Throws UsageError: `option` was given as `text`, but `expected` was.
[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& expected);

} // namespace gnomon::settings
