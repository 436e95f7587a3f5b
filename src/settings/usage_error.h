// Errors in the command line, after which the program ends with exit code 2. All other errors are gnomon::Error.
#pragma once

#include <string>

namespace gnomon::settings {

/// A contradiction between options, or an invalid value of an option. The program prints the message and exits with
/// code 2.
struct UsageError {
    std::string option; // the option concerned: "--warp"; empty if the command line as a whole is wrong
    std::string message;
};

/// Throws UsageError with a message that `option` has the invalid value `text`, and that `expected` describes valid
/// values.
[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& expected);

} // namespace gnomon::settings
