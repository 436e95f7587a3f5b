// Names of unfinished files and folders. They are removed with their object, or when a signal ends the process.
#pragma once

#include <functional>
#include <string>

namespace gnomon {

/// A file or folder that the destructor removes unless `keep` was called. A folder with content is not removed.
class TemporaryName {
public:
    /// Runs `make`, which creates `path` and returns true on success. If `make` fails, nothing will be removed. Signals
    /// are blocked during the call.
    TemporaryName(std::string path, const std::function<bool()>& make);
    ~TemporaryName();
    TemporaryName(const TemporaryName&) = delete;
    TemporaryName& operator=(const TemporaryName&) = delete;
    TemporaryName(TemporaryName&&) = delete;
    TemporaryName& operator=(TemporaryName&&) = delete;

    const std::string& path() const { return path_; }

    /// Returns true if the destructor will remove the name.
    bool isHeld() const { return isHeld_; }

    /// Runs `finish`, for example a rename, and returns its result. If `finish` returns true, the name is no longer
    /// removed.
    bool keep(const std::function<bool()>& finish);

    /// Removes all temporary names, newest first. Used when the process ends without running the destructors.
    static void removeAll();

    /// Removes all temporary names and ends the process immediately. A signal handler can call this function.
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
