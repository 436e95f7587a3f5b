// Caches byte ranges of web addresses on disk, with a size limit.
#pragma once

#include "core/units.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>

namespace gnomon::hierarchy {

/// A cache folder on disk that many processes and threads can share. Each file contains a byte range and its checksum.
/// The least recently used files are evicted first. Errors are ignored: if the disk is full or a file is damaged, the
/// range counts as absent. The cache removes only files whose names have its own format. It does not follow links in
/// its folder.
class RangeCache {
public:
    /// Creates a cache in `folder` for the content that `content` identifies. The size limit `cap` applies to all files
    /// in the folder together, also to those of other contents.
    RangeCache(const std::string& folder, Bytes cap, const std::string& content);

    /// Reads the range that begins at `offset` into `out`. Returns true if exactly this range is in the cache and
    /// undamaged.
    bool get(std::uint64_t offset, std::span<std::byte> out) const;

    /// Stores `bytes` as the range that begins at `offset`. Replaces an earlier file of this range.
    void put(std::uint64_t offset, std::span<const std::byte> bytes) const;

private:
    std::string pathOf(std::uint64_t offset, std::uint64_t size) const;
    void evictFor(std::uint64_t bytes) const;

    std::string folder_;
    std::string place_; // folder of this content inside the cache folder
    Bytes cap_;
    mutable std::mutex mutex_;
    // The size of the cache folder in bytes, without files that other processes have written since the last count.
    mutable std::uint64_t total_ = 0;
    mutable std::uint64_t uncounted_ = ~std::uint64_t{0}; // bytes that this process wrote since the last count
};

/// Returns the default folder of the cache for web servers: XDG_CACHE_HOME/gnomon/ranges, or ~/.cache/gnomon/ranges.
/// Returns an empty text if neither XDG_CACHE_HOME nor HOME is set.
std::string defaultCacheFolder();

} // namespace gnomon::hierarchy
