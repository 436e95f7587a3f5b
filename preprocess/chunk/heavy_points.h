// Grid points with too many corners for one chunk, and the detection of repeated triangles between them.
#pragma once

#include "preprocess/chunk/chunk_streams.h"

#include <optional>
#include <vector>

namespace gnomon::chunk {

/// The heavy points of a source. A grid point cannot be divided, so repeated triangles between heavy points must be
/// dropped before the binning. The class knows only two facts per corner: its heavy point, and whether it has the
/// position of the first vertex there.
class HeavyPoints {
public:
    /// Uses the first `maxPoints` points of `points`.
    HeavyPoints(std::vector<hierarchy::GridPoint> points, std::size_t maxPoints);

    std::size_t size() const { return points_.size(); }

    const hierarchy::GridPoint& operator[](std::size_t which) const { return points_[which]; }

    /// Returns the place of a vertex that snaps to `point`: twice the number of the heavy point, plus one if its
    /// position differs from the first vertex there. Returns nothing if `point` is not heavy.
    std::optional<std::uint32_t> find(const hierarchy::GridPoint& point, const glm::dvec3& position);

    /// Returns true if the triangle certainly repeats an earlier one, and counts it in `dropped`. `found` contains the
    /// results of `find` for its corners. The reason for the drop must be known without positions. The memory is
    /// bounded, so the function misses some repeats.
    bool isRepeated(
        const read::TriangleCorners& corners, const std::array<std::uint32_t, 3>& found, DroppedTriangles& dropped);

private:
    std::vector<hierarchy::GridPoint> points_; // ascending
    std::vector<std::optional<glm::dvec3>> first_;
    // Hash table of triangles of three heavy points; a new entry replaces an old one.
    std::vector<std::uint64_t> earlier_;
};

} // namespace gnomon::chunk
