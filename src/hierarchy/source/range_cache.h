// A disk cache of byte ranges with a size limit.
#pragma once

#include "core/units.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>

namespace gnomon::hierarchy {

/// A cache folder that many processes can share. Each file is a range with its checksum, and the least recently used
/// files are evicted first. Errors are ignored: if the disk is full or a file is damaged, the range is simply absent.
/// The cache removes only files whose names it could have made, and follows no links in its folder. Many threads can
/// use one cache.
class RangeCache {
public:
    /// Makes a cache in `folder` for the content with the key `content`. The size limit `cap` covers the ranges of all
    /// contents in the folder.
    RangeCache(const std::string& folder, Bytes cap, const std::string& content);

    /// Fills `out` from `offset` and returns true if this exact range is in the cache and undamaged.
    bool get(std::uint64_t offset, std::span<std::byte> out) const;

    /// Stores `bytes` for the range from `offset`, and replaces an earlier file of this range.
    void put(std::uint64_t offset, std::span<const std::byte> bytes) const;

private:
    std::string pathOf(std::uint64_t offset, std::uint64_t size) const;
    void evictFor(std::uint64_t bytes) const;

    std::string folder_;
    std::string place_; // the folder of this content
    Bytes cap_;
    mutable std::mutex mutex_;
    // Size of the folder in bytes, without files that other processes wrote since the last count.
    mutable std::uint64_t total_ = 0;
    mutable std::uint64_t uncounted_ = ~std::uint64_t{0}; // bytes written since the last count
};

/// Returns XDG_CACHE_HOME/gnomon/ranges, or ~/.cache/gnomon/ranges. Returns an empty text if the environment has
/// neither variable.
std::string defaultCacheFolder();

} // namespace gnomon::hierarchy
