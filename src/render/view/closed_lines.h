// Detection of the closed intersection lines of a plane and a model. All lines count as closed except a set of min
// total length.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

namespace gnomon::render {

/// A directed intersection line of a plane and a triangle. Seen from the side of the plane's normal, solid material is
/// on its left. Coordinates are cells from the origin of camera-relative space.
struct SectionLine {
    glm::dvec3 from{0};
    glm::dvec3 to{0};
    bool isClosed = false; // true if it belongs to closed lines
};

/// Marks the closed lines, in which each end point has as many outgoing as incoming lines. Lines with bit-identical
/// ends are connected first, so a closed surface stays closed even if it touches others.
/// For the remaining lines, ends within two cells are merged. Ends up to eight cells apart can be connected by
/// additional lines, which are appended. The removed lines plus the added lines have the min total length. Therefore an
/// open part that touches a closed one does not open it. Two parts that share one face, of which the model stores only
/// one copy, are both closed.
/// Ends of closed lines are moved to their merged position, so that they match exactly. The algorithm is min-cost flow
/// by shortest paths with potentials (Edmonds, Karp 1972). Ties are broken by the order of `lines`.
void markClosed(std::vector<SectionLine>& lines);

} // namespace gnomon::render
