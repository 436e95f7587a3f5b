// Heavy points are grid points with more triangle corners than an eighth of the limit of a chunk. The class finds
// repeated triangles between such points.
#pragma once

#include "preprocess/chunk/chunk_streams.h"

#include <optional>
#include <vector>

namespace gnomon::chunk {

/// Finds repeated triangles between heavy points, which are grid points with many triangle corners. A grid point cannot
/// be divided into chunks, so such triangles must be dropped before the source is sorted. The class stores only two
/// facts per corner: the heavy point, and whether the corner has the same position as the first vertex at this point.
class HeavyPoints {
public:
    /// Stores the first `maxPoints` grid points of `points` as heavy points.
    HeavyPoints(std::vector<hierarchy::GridPoint> points, std::size_t maxPoints);

    std::size_t size() const { return points_.size(); }

    const hierarchy::GridPoint& operator[](std::size_t which) const { return points_[which]; }

    /// Returns a code for a vertex that snaps to the heavy point `point`. The code is twice the index of the heavy
    /// point. It is one higher if the position of the vertex differs from the first vertex at this point. Returns
    /// nullopt if `point` is not heavy.
    std::optional<std::uint32_t> find(const hierarchy::GridPoint& point, const glm::dvec3& position);

    /// Returns true if the triangle certainly repeats an earlier triangle, and counts it in `dropped`. `found` contains
    /// the results of `find` for the three corners. The function misses some repeated triangles, because its memory is
    /// bounded, and because it cannot always determine the reason of the drop without positions.
    bool isRepeated(
        const read::TriangleCorners& corners, const std::array<std::uint32_t, 3>& found, DroppedTriangles& dropped);

private:
    std::vector<hierarchy::GridPoint> points_; // ascending
    std::vector<std::optional<glm::dvec3>> first_;
    // Hash table of the triangles between three heavy points. A new triangle replaces an old triangle with the same
    // hash.
    std::vector<std::uint64_t> earlier_;
};

} // namespace gnomon::chunk
