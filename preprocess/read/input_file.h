// Input files that are read several times. They are checked for changes between the reads.
#pragma once

#include "core/file.h"
#include "core/progress.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::read {

/// Throws Error if `path` is a pipe, a socket or a device, because they cannot be read several times. A missing file is
/// not an error here. Opening the file reports that error.
void requireRereadable(const std::string& path);

/// A file that is read several times. Another process may change the file between two reads. A build must not mix both
/// versions.
class InputFile {
public:
    /// Opens the file `path`. Throws Error with the reason of the operating system.
    explicit InputFile(const std::string& path);

    const std::string& path() const { return file_.path(); }

    /// Returns the size of the file in bytes at the time of opening.
    std::uint64_t size() const { return size_; }

    /// Reads up to `out.size()` bytes from `offset` and returns their number. The number is smaller only at the end
    /// that the file had when it was opened. Throws Error if the file has become shorter. Polls the progress of
    /// pollWith.
    std::size_t readSomeAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Fills `out` with the bytes from `offset` on. Throws Error if the file ends before.
    void readAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Throws Error if the size or the modification time has changed since the file was opened.
    void requireUnchanged() const;

    /// Makes all later calls of readSomeAt poll `progress`. `progress` must outlive these calls.
    void pollWith(Progress& progress) { progress_ = &progress; }

private:
    File file_;
    std::uint64_t size_;
    std::int64_t changeTime_;
    Progress* progress_ = nullptr;
};

} // namespace gnomon::read
