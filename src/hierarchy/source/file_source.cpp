#include "hierarchy/source/file_source.h"

#include "core/error.h"
#include "core/formatted.h"

#include <chrono>
#include <thread>

namespace gnomon::hierarchy {

FileSource::FileSource(const std::string& path)
    : file_(path, File::Mode::Read), size_(file_.size()), changed_(file_.changeTime()) {}

/// Reads the file with retries, because a network file system or a disk that wakes up can fail temporarily.
void FileSource::readAt(std::uint64_t offset, std::span<std::byte> out) const {
    constexpr int kRetries = 3;
    std::chrono::milliseconds pause(1);
    for (int retry = 0; retry < kRetries; ++retry, pause *= 4) {
        try {
            return file_.readAt(offset, out);
        } catch (const Error&) {
            std::this_thread::sleep_for(pause);
        }
    }
    file_.readAt(offset, out);
}

Fate FileSource::fate() const {
    try {
        return File(file_.path(), File::Mode::Read).changeTime() == changed_ ? Fate::Same : Fate::Changed;
    } catch (const Error&) {
        return Fate::Gone;
    }
}

std::string FileSource::stamp() const {
    return formatted(
        "%llu bytes, changed at %lld", static_cast<unsigned long long>(size_), static_cast<long long>(changed_));
}

} // namespace gnomon::hierarchy
