// Opens an input file that a build reads several times, and detects changes of the file between two reads.
#pragma once

#include "core/file.h"
#include "core/progress.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::read {

/// Throws Error if `path` is a pipe, a socket or a device, because such a file can be read only once. A missing file
/// causes no error here but later, when it is opened.
void requireRereadable(const std::string& path);

/// A file that a build reads several times. Another process may change the file between two reads. The build must then
/// fail instead of mixing both versions.
class InputFile {
public:
    /// Opens the file `path`. Throws Error with the operating system's reason if this fails.
    explicit InputFile(const std::string& path);

    const std::string& path() const { return file_.path(); }

    /// Returns the size in bytes that the file had when it was opened.
    std::uint64_t size() const { return size_; }

    /// Reads up to `out.size()` bytes at the byte position `offset` and returns the number of bytes. The number is
    /// smaller than out.size() only at the end of the file. Throws Error if the file has become shorter since it was
    /// opened. Polls the Progress of pollWith, so that the user can interrupt the read.
    std::size_t readSomeAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Fills `out` with the bytes at the byte position `offset`. Throws Error if the file ends before `out` is full.
    void readAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Throws Error if the file's size or modification time has changed since the file was opened.
    void requireUnchanged() const;

    /// Makes all later reads poll `progress`, so that the user can interrupt them. `progress` must outlive these reads.
    void pollWith(Progress& progress) { progress_ = &progress; }

private:
    File file_;
    std::uint64_t size_;
    std::int64_t changeTime_;
    Progress* progress_ = nullptr;
};

} // namespace gnomon::read
