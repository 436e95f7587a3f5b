// The names of files and folders that are not finished: they go with their object, or with a process that a signal
// ends.
#pragma once

#include <functional>
#include <string>

namespace gnomon {

/// A file or an empty folder that is removed in the end unless `keep` was called; one that holds something stays.
class TemporaryName {
public:
    /// Runs `make`, which brings `path` into being and returns whether it did: if not, there is nothing to remove. No
    /// signal comes in between.
    TemporaryName(std::string path, const std::function<bool()>& make);
    ~TemporaryName();
    TemporaryName(const TemporaryName&) = delete;
    TemporaryName& operator=(const TemporaryName&) = delete;
    TemporaryName(TemporaryName&&) = delete;
    TemporaryName& operator=(TemporaryName&&) = delete;

    const std::string& path() const { return path_; }

    /// Whether the name is to be removed.
    bool isHeld() const { return isHeld_; }

    /// Runs `finish`, such as a rename, and leaves the name alone from then on if that returns true; so it returns.
    bool keep(const std::function<bool()>& finish);

    /// Removes all temporary names, newest first, whose objects will not do it: the process is about to end.
    static void removeAll();

    /// Does that and ends the process at once. May be called by a signal's handler.
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
