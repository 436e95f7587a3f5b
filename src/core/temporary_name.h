// Temporary files and folders. A file is removed when its object is destroyed, or when a signal ends the process.
#pragma once

#include <functional>
#include <string>

namespace gnomon {

/// A temporary file or folder. The destructor removes it unless `keep` was called. A folder that is not empty remains.
class TemporaryName {
public:
    /// Runs `make`, which must create `path` and return true on success. If it returns false, the destructor removes
    /// nothing. Signals are blocked during the call.
    TemporaryName(std::string path, const std::function<bool()>& make);
    ~TemporaryName();
    TemporaryName(const TemporaryName&) = delete;
    TemporaryName& operator=(const TemporaryName&) = delete;
    TemporaryName(TemporaryName&&) = delete;
    TemporaryName& operator=(TemporaryName&&) = delete;

    const std::string& path() const { return path_; }

    /// Returns true if the destructor will remove the file or folder.
    bool isHeld() const { return isHeld_; }

    /// Runs `finish`, for example a rename, and returns its result. If the result is true, the destructor no longer
    /// removes the file.
    bool keep(const std::function<bool()>& finish);

    /// Removes all temporary files and folders of the process, newest first. Used when the process ends without running
    /// destructors.
    static void removeAll();

    /// Removes all temporary files and folders, and ends the process immediately with exit code `status`. A signal
    /// handler can call this function.
    [[noreturn]] static void removeAllAndExit(int status);

private:
    static void removeNames();
    void enter();
    void leave();

    std::string path_;
    bool isHeld_ = false;
    TemporaryName* older_ = nullptr;
    TemporaryName* newer_ = nullptr;
};

} // namespace gnomon
