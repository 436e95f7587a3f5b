// Cutting weighted points into compact parts of bounded weight by planes.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::levels {

/// A point, finite, that stands for `weight` triangles.
struct KdItem {
    glm::vec3 center{0};
    std::uint32_t weight = 1; // at least 1
    std::uint32_t index = 0;  // the caller's, its own; breaks ties, so the parts are the same everywhere
};

/// Parts are contiguous in `order`.
struct KdParts {
    std::vector<std::uint32_t> order; // the indices of the items
    std::vector<std::uint32_t> ends;  // where each part ends in `order`
};

/// Cuts `items` into parts. A part weighs at most `maxWeight` (at least 1) unless it is a single item. Each cut is
/// across the widest axis, at the widest gap if that is wide and leaves `leastAtGap` on either side (kd_gap.h: so a
/// part seldom spans what is far apart), else so that it leaves about `fraction` of the weight on its low side; parts
/// come in the order of the cuts, so neighbours in that order are near each other. Within a part items are ordered by
/// index. Bentley, "Multidimensional binary search trees", 1975.
KdParts kdSplit(std::span<const KdItem> items, std::uint64_t maxWeight, double fraction, std::uint64_t leastAtGap = 0);

} // namespace gnomon::levels
