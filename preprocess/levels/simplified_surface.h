// Maps points of a patch to the simplified patch. The transfers of normals, colours and fields use this mapping.
#pragma once

#include "preprocess/proximity/triangle_batch.h"
#include "preprocess/simplify/patch.h"
#include "preprocess/simplify/triangle_adjacency.h"

#include <array>
#include <span>

namespace gnomon::levels {

/// Returns the barycentric coordinates of a point in the triangle `t` that is approximately nearest to `p`. Their sum
/// is 1.
glm::dvec3 weightsAt(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t);

/// The triangles of a simplified patch and the lists of triangles around each position. The original and the simplified
/// patch must outlive the object.
class SimplifiedSurface {
public:
    SimplifiedSurface(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

    /// Returns the corner coordinates of `t`, which is a triangle of the original patch.
    std::array<glm::dvec3, 3> placesOf(const simplify::Triangle& t) const { return places(patch_.corners(t)); }

    /// Returns the corner coordinates of triangle `number` of the simplified patch.
    std::array<glm::dvec3, 3> placesOfSimplified(std::uint32_t number) const {
        return places(simplified_.corners(patch_, simplified_.triangles[number]));
    }

    /// Returns the simplified triangles around the position onto which `position` was collapsed.
    std::span<const std::uint32_t> around(std::uint32_t position) const {
        return adjacency_.around(simplified_.movedTo[position]);
    }

    /// Returns the triangle in the list `among` that is nearest to `p`. The list contains simplified triangles. Among
    /// equal distances the first triangle is returned. Returns kNone if `among` is empty.
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
