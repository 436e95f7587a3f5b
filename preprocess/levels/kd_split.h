// Splits weighted points into compact parts of bounded weight by axis-aligned planes.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::levels {

/// A finite point that represents `weight` triangles.
struct KdItem {
    glm::vec3 center{0};
    std::uint32_t weight = 1; // at least 1
    std::uint32_t index = 0;  // unique index chosen by the caller; breaks ties, so that the result is deterministic
};

/// A division of items into parts that are contiguous in `order`.
struct KdParts {
    std::vector<std::uint32_t> order; // indices of the items
    std::vector<std::uint32_t> ends;  // end of each part in `order`
};

/// Splits `items` into parts of at most `maxWeight` (at least 1). A part may exceed this weight only if it is a single
/// item. Each cut is across the widest axis. It uses the widest gap if `weightBeforeGap` finds one with at least
/// `minWeightAtGap` on each side, so that a part seldom contains distant points. Otherwise the low side gets about
/// `fraction` of the weight. Neighbours in the order of parts are near each other in space. Within a part, items are
/// ordered by index (Bentley, "Multidimensional binary search trees", 1975).
KdParts kdSplit(
    std::span<const KdItem> items, std::uint64_t maxWeight, double fraction, std::uint64_t minWeightAtGap = 0);

} // namespace gnomon::levels
