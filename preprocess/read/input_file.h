// Input files that are read several times, with a check that they do not change meanwhile.
#pragma once

#include "core/file.h"
#include "core/progress.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::read {

/// Throws Error if `path` is a pipe, a socket or a device, because a source is read several times. A missing file is
/// not an error here; opening it reports the error.
void requireRereadable(const std::string& path);

/// A file that is read several times. Another process may change the file meanwhile, and a build must not mix both
/// versions.
class InputFile {
public:
    /// Opens the file `path`. Throws Error with the reason of the operating system.
    explicit InputFile(const std::string& path);

    const std::string& path() const { return file_.path(); }

    /// Returns the size of the file in bytes at the time of opening.
    std::uint64_t size() const { return size_; }

    /// Reads up to `out.size()` bytes from `offset` and returns their number. Returns fewer only at the original end of
    /// the file. Throws Error if the file has become shorter. Polls the progress of pollWith.
    std::size_t readSomeAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Fills `out` with the bytes from `offset` on. Throws Error if the file ends before.
    void readAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Throws Error if the size or the modification time has changed since the file was opened.
    void requireUnchanged() const;

    /// Makes all later calls of readSomeAt poll `progress`, which must outlive them.
    void pollWith(Progress& progress) { progress_ = &progress; }

private:
    File file_;
    std::uint64_t size_;
    std::int64_t changeTime_;
    Progress* progress_ = nullptr;
};

} // namespace gnomon::read
