#include "render/gl/free_list.h"

#include "core/check.h"

#include <iterator>

namespace gnomon::render {

std::optional<std::size_t> FreeList::take(std::size_t units) {
    for (auto range = free_.begin(); range != free_.end(); ++range) {
        if (range->second < units) continue;
        const auto [offset, size] = *range;
        free_.erase(range);
        if (size > units) free_.emplace(offset + units, size - units);
        return offset;
    }
    return std::nullopt;
}

void FreeList::release(std::size_t offset, std::size_t units) {
    auto [range, isNew] = free_.emplace(offset, units);
    GNOMON_CHECK(isNew);
    const auto next = std::next(range);
    if (next != free_.end() && range->first + range->second == next->first) {
        range->second += next->second;
        free_.erase(next);
    }
    if (range == free_.begin()) return;
    const auto before = std::prev(range);
    if (before->first + before->second == range->first) {
        before->second += range->second;
        free_.erase(range);
    }
}

} // namespace gnomon::render
