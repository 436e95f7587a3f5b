// First-fit allocation of ranges out of a fixed span of units.
#pragma once

#include <cstddef>
#include <map>
#include <optional>

namespace gnomon::executor {

/// Free ranges by offset; neighbours are merged when they are given back.
class FreeList {
public:
    FreeList() = default;

    explicit FreeList(std::size_t units) {
        if (units > 0) free_.emplace(0, units);
    }

    /// The offset of `units` free units, which are then taken; nothing if no range is large enough.
    std::optional<std::size_t> take(std::size_t units);

    /// Gives back a range that `take` returned.
    void release(std::size_t offset, std::size_t units);

private:
    std::map<std::size_t, std::size_t> free_; // offset -> units
};

} // namespace gnomon::executor
