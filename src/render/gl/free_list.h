// First-fit allocation of ranges from a fixed span of units.
#pragma once

#include <cstddef>
#include <map>
#include <optional>

namespace gnomon::render {

/// An allocator that keeps free ranges by offset. Released ranges are merged with their neighbours.
class FreeList {
public:
    FreeList() = default;

    explicit FreeList(std::size_t units) {
        if (units > 0) free_.emplace(0, units);
    }

    /// Allocates `units` units and returns their offset, or nullopt if no free range is large enough.
    std::optional<std::size_t> take(std::size_t units);

    /// Frees a range that `take` returned.
    void release(std::size_t offset, std::size_t units);

private:
    std::map<std::size_t, std::size_t> free_; // offset -> units
};

} // namespace gnomon::render
