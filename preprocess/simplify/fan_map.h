// The successive mapping of one collapse: bounds how far a fan of triangles moves when its apex collapses onto a corner
// of its rim, by a piecewise linear map between the two.
#pragma once

#include "preprocess/simplify/patch.h"

#include <array>

namespace gnomon::simplify {

/// The triangles around a collapsing vertex, edge to edge around `apex`: old triangle i is (apex, rim i, rim i + 1),
/// and on a closed rim one more leads from the last back to the first. The apex moves onto rim 0, which leaves the new
/// triangles j = 1 ... count - 2: (rim 0, rim j, rim j + 1).
struct Fan {
    static constexpr std::uint32_t kMaxRim = 24;

    glm::dvec3 apex{0};
    std::array<glm::dvec3, kMaxRim> rim{};
    std::uint32_t count = 0; // corners of the rim; at least 3
    bool isClosed = false;
    std::array<double, kMaxRim> fromSource{}; // of the old triangles, as in TriangleError
    std::array<double, kMaxRim> toSource{};
};

/// What is known of the new triangles, [1, count - 1) of each array.
struct FanAfter {
    std::array<double, Fan::kMaxRim> fromSource{};
    std::array<double, Fan::kMaxRim> toSource{};
};

/// Bounds the errors of the new triangles of `fan`. Where old edges from the apex and new edges from rim 0 cross, both
/// fans are cut into the same cells; cells are mapped linearly onto each other, so that no point moves farther than
/// some cell's corner. This holds wherever the crossings are put, as long as they keep their order along each edge;
/// they are put where the two edges are nearest. Cohen, Manocha and Olano, "Simplifying Polygonal Models Using
/// Successive Mappings", 1997.
FanAfter mapFan(const Fan& fan);

} // namespace gnomon::simplify
