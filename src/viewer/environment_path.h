// Folders of the user that the environment names.
#pragma once

#include <cstdlib>
#include <string>

namespace gnomon::viewer {

/// Returns the absolute path in the environment variable `name`, or nothing: the XDG Base Directory Specification says
/// that relative paths are ignored.
inline std::string environmentPath(const char* name) {
    const char* value = std::getenv(name); // NOLINT(concurrency-mt-unsafe): nothing here sets any
    return value != nullptr && *value == '/' ? value : "";
}

} // namespace gnomon::viewer
