// Finds closed outlines among the intersection lines of a plane and a model. The lines that
// stay open have the min total length.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

namespace gnomon::render {

/// A directed intersection line of a plane and a triangle. Seen from the side of the plane's normal, solid material is
/// on the left of the line. Coordinates are in cells from the origin of camera-relative space.
struct SectionLine {
    glm::dvec3 from{0};
    glm::dvec3 to{0};
    bool isClosed = false; // true: the line is a part of a closed outline
};

/// Marks the closed lines. In the set of closed lines, each end point has as many outgoing as incoming lines. Lines
/// with bit-identical ends are connected first, so a closed surface stays closed even if it touches other surfaces.
///
/// In the remaining lines, ends within two cells are merged. Ends up to eight cells apart can be connected by
/// additional lines, which are appended to `lines`. The removed lines and the added lines together have the min total
/// length. Therefore an open part that touches a closed part does not open it. If two parts share a face of which the
/// model stores only one copy, both are closed.
///
/// Ends of closed lines are moved to their merged position, so that they match exactly. The algorithm is min-cost flow
/// by shortest paths with potentials (Edmonds, Karp 1972). The order of `lines` breaks ties.
void markClosed(std::vector<SectionLine>& lines);

} // namespace gnomon::render
