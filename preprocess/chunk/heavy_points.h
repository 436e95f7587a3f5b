// The points of the grid at which too many corners lie for a chunk, and the repeated triangles between them.
#pragma once

#include "preprocess/chunk/chunk_streams.h"

#include <optional>
#include <vector>

namespace gnomon::chunk {

/// A point of the grid cannot be cut, so triangles that repeat each other there are left out before they reach a chunk.
/// They are told by their points alone: which of the points a corner lies at, and whether at the very position of the
/// first vertex that was seen there.
class HeavyPoints {
public:
    /// Of `points`, the first `most`.
    HeavyPoints(std::vector<hierarchy::GridPoint> points, std::size_t most);

    std::size_t size() const { return points_.size(); }

    const hierarchy::GridPoint& operator[](std::size_t which) const { return points_[which]; }

    /// Where a vertex lies that snaps to `point`: twice the number of the heavy point, and one more unless it is at the
    /// position of the first vertex there. None where no heavy point is.
    std::optional<std::uint32_t> find(const hierarchy::GridPoint& point, const glm::dvec3& position);

    /// Whether the triangle of `corners`, which lie at `found` as `find` tells, is left out of the source for sure: its
    /// points are those of an earlier triangle, and why it is dropped is known without its positions; `dropped` counts
    /// it then. Not all repeats are found: what is remembered is bounded.
    bool isRepeated(
        const read::TriangleCorners& corners, const std::array<std::uint32_t, 3>& found, DroppedTriangles& dropped);

private:
    std::vector<hierarchy::GridPoint> points_; // ascending
    std::vector<std::optional<glm::dvec3>> first_;
    std::vector<std::uint64_t> earlier_; // triangles of three heavy points, by hash; the last one stays
};

} // namespace gnomon::chunk
