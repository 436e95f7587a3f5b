// Lists of the triangles around each position, stored in one array with offsets.
#pragma once

#include "preprocess/simplify/mesh.h"

#include <span>

namespace gnomon::simplify {

/// The triangles around each position of a mesh.
class TriangleAdjacency {
public:
    /// Builds the lists for `triangles`, whose corners are positions 0 to `positionCount` - 1.
    TriangleAdjacency(std::size_t positionCount, std::span<const Triangle> triangles)
        : first_(positionCount + 1, 0), members_(triangles.size() * 3) {
        for (const Triangle& t : triangles)
            for (const std::uint32_t p : t)
                ++first_[p + 1];
        for (std::size_t p = 0; p < positionCount; ++p)
            first_[p + 1] += first_[p];
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t t = 0; t < triangles.size(); ++t)
            for (const std::uint32_t p : triangles[t])
                members_[next[p]++] = t;
    }

    /// Returns the triangles that have a corner at `position`, in ascending order.
    std::span<const std::uint32_t> around(std::uint32_t position) const {
        return std::span(members_).subspan(first_[position], first_[position + 1] - first_[position]);
    }

private:
    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> members_;
};

} // namespace gnomon::simplify
