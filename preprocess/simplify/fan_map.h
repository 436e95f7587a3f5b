// Bounds how far an edge collapse moves the surface of a triangle fan. The apex of the fan collapses onto a corner of
// its rim. The bound comes from a piecewise linear map between the fans before and after the collapse (successive
// mapping).
#pragma once

#include "preprocess/simplify/patch.h"

#include <array>

namespace gnomon::simplify {

/// The triangles around a collapsing vertex (the apex), ordered edge to edge. Triangle i before the collapse is (apex,
/// rim i, rim i + 1). A closed rim has one more triangle from its last corner to the first. The apex moves onto rim 0.
/// The new triangles are (rim 0, rim j, rim j + 1) for j = 1 ... count - 2.
struct Fan {
    static constexpr std::uint32_t kMaxRim = 24;

    glm::dvec3 apex{0};
    std::array<glm::dvec3, kMaxRim> rim{};
    std::uint32_t count = 0; // number of rim corners; at least 3
    bool isClosed = false;
    std::array<double, kMaxRim> fromSource{}; // errors of the triangles before the collapse, as in TriangleError
    std::array<double, kMaxRim> toSource{};
};

/// The error bounds of the triangles after the collapse. In each array the entries [1, count - 1) are valid.
struct FanAfter {
    std::array<double, Fan::kMaxRim> fromSource{};
    std::array<double, Fan::kMaxRim> toSource{};
};

/// Returns upper bounds of the errors of the triangles after the collapse of `fan` (Cohen, Manocha, Olano, "Simplifying
/// Polygonal Models Using Successive Mappings", 1997). The old edges from the apex cross the new edges from rim 0.
/// These crossings divide the old fan and the new fan into corresponding cells. The map is linear in each cell, so no
/// point moves farther than a corner of its cell. The bound is valid for any positions of the crossings that preserve
/// their order along each edge. The function places each crossing where its two edges are nearest.
FanAfter mapFan(const Fan& fan);

} // namespace gnomon::simplify
