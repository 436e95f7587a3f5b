// Heavy points: grid points with too many triangle corners for one chunk. The class finds repeated triangles between
// them.
#pragma once

#include "preprocess/chunk/chunk_streams.h"

#include <optional>
#include <vector>

namespace gnomon::chunk {

/// The heavy points of a source. A grid point cannot be divided into chunks, so repeated triangles between heavy points
/// must be dropped before the binning. The class stores only two facts per corner: the heavy point, and whether the
/// corner has the same position as the first vertex at this point.
class HeavyPoints {
public:
    /// Creates the object with the first `maxPoints` points of `points`.
    HeavyPoints(std::vector<hierarchy::GridPoint> points, std::size_t maxPoints);

    std::size_t size() const { return points_.size(); }

    const hierarchy::GridPoint& operator[](std::size_t which) const { return points_[which]; }

    /// Returns a code for a vertex that snaps to the heavy point `point`: twice the number of the point. If the
    /// position of the vertex differs from the first vertex at this point, the code is one higher. Returns nullopt if
    /// `point` is not heavy.
    std::optional<std::uint32_t> find(const hierarchy::GridPoint& point, const glm::dvec3& position);

    /// Returns true if the triangle certainly repeats an earlier one, and counts it in `dropped`. `found` contains the
    /// results of `find` for its corners. The function misses some repeated triangles for two reasons: its memory is
    /// bounded, and it cannot always determine the reason of the drop without positions.
    bool isRepeated(
        const read::TriangleCorners& corners, const std::array<std::uint32_t, 3>& found, DroppedTriangles& dropped);

private:
    std::vector<hierarchy::GridPoint> points_; // ascending
    std::vector<std::optional<glm::dvec3>> first_;
    // Hash table of triangles between three heavy points. A new entry replaces an old entry with the same hash.
    std::vector<std::uint64_t> earlier_;
};

} // namespace gnomon::chunk
