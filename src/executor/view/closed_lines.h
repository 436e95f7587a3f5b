// Which of the lines in which a plane meets a model are closed: all but the least length that has to be left out.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

namespace gnomon::executor {

/// A directed line in which a plane meets a triangle, what is solid to its left as seen from where the plane's normal
/// points to. Cells from draw space's origin.
struct SectionLine {
    glm::dvec3 from{0};
    glm::dvec3 to{0};
    bool isClosed = false; // it is part of closed lines
};

/// Marks those of `lines` that belong to closed ones, by which each end is left as often as it is reached. Lines whose
/// ends agree to the bit are joined first: what is closed by itself stays so, whatever it touches. Of the others, ends
/// within two cells of each other are one, and those lines are left out, and ends up to eight cells apart joined by
/// lines that are appended, that are of the least length in all: an open part that touches a closed one takes nothing
/// of it along, and parts of which the model keeps one of two equal faces are closed around both. The ends of closed
/// lines are moved to where the others are that they are one with, so that they meet to the bit. A minimum cost flow,
/// by shortest paths with potentials (Edmonds, Karp 1972); among equal lengths the order of `lines` decides.
void markClosed(std::vector<SectionLine>& lines);

} // namespace gnomon::executor
