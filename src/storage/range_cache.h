// Ranges of what lies at an address, kept on this machine's disk under a cap.
#pragma once

#include "core/units.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>

namespace gnomon::storage {

/// Files in a folder that many processes may share, each a range with its checksum; the longest unused go first. It is
/// a help and never a fault: where a disk is full or a file is damaged, nothing was kept. It removes only files with
/// names that it makes, and it follows no link from that folder on. Safe from many threads.
class RangeCache {
public:
    /// Keeps ranges of the content that `content` tells from all others, in `folder`, which all of them together fill
    /// up to `cap`.
    RangeCache(const std::string& folder, Bytes cap, const std::string& content);

    /// Fills `out` from `offset` if that very range was kept, and is whole.
    bool get(std::uint64_t offset, std::span<std::byte> out) const;

    /// Keeps `bytes` from `offset` in place of what was kept there.
    void put(std::uint64_t offset, std::span<const std::byte> bytes) const;

private:
    std::string pathOf(std::uint64_t offset, std::uint64_t size) const;
    void makeRoom(std::uint64_t bytes) const;

    std::string folder_;
    std::string place_; // the content's own folder within
    Bytes cap_;
    mutable std::mutex mutex_;
    mutable std::uint64_t total_ = 0;                     // in the folder, others' since it was counted left out
    mutable std::uint64_t uncounted_ = ~std::uint64_t{0}; // bytes put since then
};

/// XDG_CACHE_HOME/gnomon/ranges, or ~/.cache/gnomon/ranges; empty where the environment names neither.
std::string defaultCacheFolder();

} // namespace gnomon::storage
