#include "preprocess/build/locked_edge_check.h"

#include <algorithm>

namespace gnomon::preprocess {

namespace {

/// One entry, lesser position first, for each triangle's edge between two locked positions.
std::vector<std::array<std::uint32_t, 2>> lockedEdges(const Patch& patch, const std::vector<Triangle>& triangles) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const Triangle& triangle : triangles) {
        const Triangle t = patch.corners(triangle);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i];
            const std::uint32_t b = t[(i + 1) % 3];
            if (patch.isLocked[a] != 0 && patch.isLocked[b] != 0) edges.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

} // namespace

bool keepsLockedEdges(const Patch& patch, const std::vector<Triangle>& triangles) {
    const auto before = lockedEdges(patch, patch.triangles);
    auto after = lockedEdges(patch, triangles);
    std::erase_if(after, [&](const auto& edge) { return !std::binary_search(before.begin(), before.end(), edge); });
    return before == after;
}

} // namespace gnomon::preprocess
