// Maps points of a patch to the simplified patch. The transfers of normals, colours and fields use this mapping.
#pragma once

#include "preprocess/proximity/triangle_batch.h"
#include "preprocess/simplify/patch.h"
#include "preprocess/simplify/triangle_adjacency.h"

#include <array>
#include <span>

namespace gnomon::levels {

/// Returns barycentric coordinates in `t` of a point that is approximately the nearest one to `p`. Their sum is 1.
glm::dvec3 weightsAt(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t);

/// The triangles of a simplified patch and their adjacency. Both patches must outlive the object.
class SimplifiedSurface {
public:
    SimplifiedSurface(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

    /// Returns the positions of the corners of `t`, which is a triangle of the original patch.
    std::array<glm::dvec3, 3> placesOf(const simplify::Triangle& t) const { return places(patch_.corners(t)); }

    /// Returns the positions of the corners of the simplified triangle `number`.
    std::array<glm::dvec3, 3> placesOfSimplified(std::uint32_t number) const {
        return places(simplified_.corners(patch_, simplified_.triangles[number]));
    }

    /// Returns the simplified triangles around the position that `position` was collapsed into.
    std::span<const std::uint32_t> around(std::uint32_t position) const {
        return adjacency_.around(simplified_.movedTo[position]);
    }

    /// Returns the simplified triangle in the list `among` that is nearest to `p`. Among equal distances it returns the
    /// first triangle. Returns kNone if `among` is empty.
    std::uint32_t nearest(const glm::dvec3& p, std::span<const std::uint32_t> among);

private:
    std::array<glm::dvec3, 3> places(const simplify::Triangle& p) const {
        return {patch_.positions[p[0]], patch_.positions[p[1]], patch_.positions[p[2]]};
    }

    const simplify::Patch& patch_;
    const simplify::SimplifiedPatch& simplified_;
    simplify::TriangleAdjacency adjacency_;
    proximity::TriangleBatch batch_;
    proximity::TriangleBatch::Row squares_{};
};

} // namespace gnomon::levels
