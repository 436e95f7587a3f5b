// Outputs that are made sure of before the long work whose results they take.
#pragma once

#include "core/file.h"

#include <optional>
#include <string>

namespace gnomon::app {

/// A file that is created at once and whose text comes later; without that, nothing is left of it.
class PreparedFile {
public:
    /// Throws Error where the file cannot be made. An empty path is an output that was not asked for.
    explicit PreparedFile(const std::string& path) {
        if (!path.empty()) file_.emplace(path);
    }

    /// Writes all of the file, if it was asked for; to be called once.
    void write(const std::string& text);

private:
    std::optional<AtomicFile> file_;
};

/// Throws Error where a file cannot be made under `path`, and leaves nothing there; an empty path is none. A device or
/// a pipe, which keeps nothing and can be opened only once, is not tried.
void requireWritable(const std::string& path);

/// Makes a folder that files can be written into, those above it too; an empty path is none. Throws Error.
void prepareFolder(const std::string& path);

} // namespace gnomon::app
