// Reads folders of the user from environment variables.
#pragma once

#include <cstdlib>
#include <string>

namespace gnomon::viewer {

/// Returns the absolute path in the environment variable `name`, or an empty text. The XDG Base Directory Specification
/// says that relative paths are ignored.
inline std::string environmentPath(const char* name) {
    const char* value = std::getenv(name); // NOLINT(concurrency-mt-unsafe): no code sets variables
    return value != nullptr && *value == '/' ? value : "";
}

} // namespace gnomon::viewer
