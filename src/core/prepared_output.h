// Outputs that are made sure of before the long work whose results they take.
#pragma once

#include "core/file.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

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

/// A folder that files can be written into, made where it is missing, as are those above it; of what was made, that is
/// removed in the end which holds nothing.
class PreparedFolder {
public:
    /// Throws Error. An empty path is a folder that was not asked for.
    explicit PreparedFolder(const std::string& path);
    ~PreparedFolder();
    PreparedFolder(const PreparedFolder&) = delete;
    PreparedFolder& operator=(const PreparedFolder&) = delete;
    PreparedFolder(PreparedFolder&&) = delete;
    PreparedFolder& operator=(PreparedFolder&&) = delete;

private:
    std::vector<std::unique_ptr<TemporaryName>> made_; // outermost first
};

} // namespace gnomon
