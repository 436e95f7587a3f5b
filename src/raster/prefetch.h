// Prefetches data into the CPU cache. The clusters of a pass are scattered in memory, so the hardware cannot predict
// which cluster comes next.
#pragma once

#include <cstddef>

#include <hwy/cache_control.h>

namespace gnomon::raster {

/// Prefetches `bytes` bytes at `memory` into the cache.
inline void prefetch(const void* memory, std::size_t bytes) {
    constexpr std::size_t kLine = 64;
    const auto* first = static_cast<const std::byte*>(memory);
    for (std::size_t i = 0; i < bytes; i += kLine)
        hwy::Prefetch(first + i);
}

} // namespace gnomon::raster
