// Where the points of a patch lie on what it was simplified to: what all transfers of attributes begin with.
#pragma once

#include "preprocess/proximity/triangle_batch.h"
#include "preprocess/simplify/patch.h"
#include "preprocess/simplify/triangle_adjacency.h"

#include <array>
#include <span>

namespace gnomon::levels {

/// The weights of the corners of `t` at the point of it that is about nearest to `p`; they sum up to 1.
glm::dvec3 weightsAt(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t);

/// The triangles of a simplified patch, by what they touch. Both must outlive it.
class SimplifiedSurface {
public:
    SimplifiedSurface(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

    /// Returns the places of the corners of `t`, a triangle of the patch.
    std::array<glm::dvec3, 3> placesOf(const simplify::Triangle& t) const { return places(patch_.corners(t)); }

    /// Returns the places of the corners of the simplified triangle `number`.
    std::array<glm::dvec3, 3> placesOfSimplified(std::uint32_t number) const {
        return places(simplified_.corners(patch_, simplified_.triangles[number]));
    }

    /// The simplified triangles around what `position` was collapsed into.
    std::span<const std::uint32_t> around(std::uint32_t position) const {
        return adjacency_.around(simplified_.movedTo[position]);
    }

    /// That of the simplified triangles `among` which is nearest to `p`, the first of several; kNone if there is none.
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
