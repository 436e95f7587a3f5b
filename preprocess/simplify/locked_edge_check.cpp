#include "preprocess/simplify/locked_edge_check.h"

#include <algorithm>

namespace gnomon::simplify {

namespace {

/// Returns each triangle edge between two locked positions, once per triangle that has it. The lower position comes
/// first.
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
    return lockedEdges(patch, patch.triangles) == lockedEdges(patch, triangles);
}

std::vector<std::uint8_t> lockedWithRing(const Patch& patch) {
    std::vector<std::uint8_t> isLocked = patch.isLocked;
    for (const Triangle& triangle : patch.triangles) {
        const Triangle t = patch.corners(triangle);
        if ((patch.isLocked[t[0]] | patch.isLocked[t[1]] | patch.isLocked[t[2]]) == 0) continue;
        for (const std::uint32_t p : t)
            isLocked[p] = 1;
    }
    return isLocked;
}

} // namespace gnomon::simplify
