// Creates output files and folders before a long computation, so that an unwritable path is an error at once.
#pragma once

#include "core/file.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// An output file that is created immediately and written later. If `write` is never called, no file remains.
class PreparedFile {
public:
    /// Creates the output file. Throws Error if this is impossible. An empty path means that no output was requested.
    explicit PreparedFile(const std::string& path) {
        if (!path.empty()) file_.emplace(path);
    }

    /// Writes `text` to the file and completes it. Does nothing if no output was requested. Must be called at most
    /// once.
    void write(const std::string& text);

private:
    std::optional<AtomicFile> file_;
};

/// Throws Error if a file at `path` cannot be created, and leaves no file there. Does nothing for an empty path. Does
/// not test a device or a pipe, because a pipe can be opened only once.
void requireWritable(const std::string& path);

/// An output folder that is tested for writing. The constructor creates the folder and its missing parents. The
/// destructor removes the created folders that are still empty.
class PreparedFolder {
public:
    /// Creates the output folder. Throws Error if this is impossible or the folder is not writable. An empty path means
    /// that no folder was requested.
    explicit PreparedFolder(const std::string& path);
    ~PreparedFolder();
    PreparedFolder(const PreparedFolder&) = delete;
    PreparedFolder& operator=(const PreparedFolder&) = delete;
    PreparedFolder(PreparedFolder&&) = delete;
    PreparedFolder& operator=(PreparedFolder&&) = delete;

private:
    std::vector<std::unique_ptr<TemporaryName>> made_; // outermost folder first
};

} // namespace gnomon
