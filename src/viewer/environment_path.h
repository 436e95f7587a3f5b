// Reads paths of the user's folders from environment variables.
#pragma once

#include <cstdlib>
#include <string>

namespace gnomon::viewer {

/// Returns the absolute path that the environment variable `name` contains. Returns an empty text for a relative path,
/// because the XDG Base Directory Specification requires programs to ignore it.
inline std::string environmentPath(const char* name) {
    const char* value = std::getenv(name); // NOLINT(concurrency-mt-unsafe): no code sets variables
    return value != nullptr && *value == '/' ? value : "";
}

} // namespace gnomon::viewer
