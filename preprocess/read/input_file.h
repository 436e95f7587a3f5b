// A file of input that stays as it was when it was opened, or is refused.
#pragma once

#include "core/file.h"
#include "core/progress.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::read {

/// Throws Error where `path` leads to something that cannot be read several times: a pipe, a socket or a device. What
/// is not there at all is left to the one who opens it.
void requireRereadable(const std::string& path);

/// An input that is read several times. Another process may change it meanwhile; nobody may build from a mix of both.
class InputFile {
public:
    /// Throws Error with the system's reason.
    explicit InputFile(const std::string& path);

    const std::string& path() const { return file_.path(); }

    /// In bytes, when it was opened.
    std::uint64_t size() const { return size_; }

    /// Up to `out.size()` bytes from `offset`; fewer only at the end that the file had when it was opened. Throws Error
    /// if bytes that were there then are gone. Polls.
    std::size_t readSomeAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Fills `out` from `offset`; throws Error if the file ends before.
    void readAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Throws Error if the size or the time of the last change is another than when the file was opened.
    void requireUnchanged() const;

    /// From now on every call of `readSomeAt` polls `progress`, which must outlive them.
    void pollWith(Progress& progress) { progress_ = &progress; }

private:
    File file_;
    std::uint64_t size_;
    std::int64_t changeTime_;
    Progress* progress_ = nullptr;
};

} // namespace gnomon::read
