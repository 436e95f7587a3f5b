// Splits weighted points into compact parts of limited weight by axis-aligned planes, like a kd-tree.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::levels {

/// A point with finite coordinates and a weight in triangles.
struct KdItem {
    glm::vec3 center{0};
    std::uint32_t weight = 1; // at least 1
    // unique index; it breaks ties, so that the result is deterministic
    std::uint32_t index = 0;
};

/// A division of items into parts. The items of each part are contiguous in `order`.
struct KdParts {
    std::vector<std::uint32_t> order; // indices of the items, part by part
    std::vector<std::uint32_t> ends;  // per part: the index in `order` after its last item
};

/// Splits `items` into compact parts of at most the weight `maxWeight` (at least 1), like a kd-tree (Bentley,
/// "Multidimensional binary search trees", 1975). A part may exceed this weight only if it is a single item. Each cut
/// is a plane across the widest axis. The plane lies in the widest gap if `weightBeforeGap` finds a gap with at least
/// `minWeightAtGap` on each side, so that a part seldom contains distant points. Without such a gap the low side
/// receives about `fraction` of the weight. Parts that are neighbours in the order are near each other in space. Within
/// a part, items are ordered by index.
KdParts kdSplit(
    std::span<const KdItem> items, std::uint64_t maxWeight, double fraction, std::uint64_t minWeightAtGap = 0);

} // namespace gnomon::levels
