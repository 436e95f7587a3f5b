// A first-fit allocator for ranges of a buffer of fixed size.
#pragma once

#include <cstddef>
#include <map>
#include <optional>

namespace gnomon::render {

/// A first-fit allocator that stores the free ranges of a buffer, sorted by offset. A released range is merged with
/// adjacent free ranges.
class FreeList {
public:
    FreeList() = default;

    explicit FreeList(std::size_t units) {
        if (units > 0) free_.emplace(0, units);
    }

    /// Allocates a range of `units` units and returns its offset, or nullopt if no free range is large enough.
    std::optional<std::size_t> take(std::size_t units);

    /// Frees a range that `take` allocated.
    void release(std::size_t offset, std::size_t units);

private:
    std::map<std::size_t, std::size_t> free_; // from the offset of a free range to its number of units
};

} // namespace gnomon::render
