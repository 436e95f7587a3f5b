// Where boxes and triangles lie over the cells of exact shadows, about: for estimates, without the bounds that shadows
// themselves are decided with.
#pragma once

#include "exact/light_shear.h"
#include "exact/receiver_mask.h"
#include "hierarchy/grid.h"

#include <glm/glm.hpp>

#include <array>

namespace gnomon::frame {

/// A box on the light plane with the greatest h of what it holds.
struct LightBox {
    exact::CellBox cells;
    float highest = 0;
};

/// Cells from the frame's origin.
glm::dvec3 fromOrigin(const hierarchy::GridPoint& p, const hierarchy::GridPoint& origin);

/// (u, v, h) of a point.
glm::dvec3 sheared(const exact::LightShear& shear, const glm::dvec3& p);

/// The cells that a triangle on the light plane reaches, with what of it has less than `leastW` left out; `places` are
/// its corners in the cells' plane before their division.
exact::CellBox cellsOf(const std::array<glm::dvec3, 3>& places, double leastW);

/// The cells that such a triangle covers, summed with fractions; those of `box`, where it is cut off.
double coveredArea(const std::array<glm::dvec3, 3>& places, double leastW, const exact::CellBox& box);

/// The cells that the box from `least` to `most` reaches; `cells` leads from the light plane to them.
LightBox lightBox(
    const exact::LightShear& shear,
    const glm::dmat3& cells,
    double leastW,
    const glm::dvec3& least,
    const glm::dvec3& most);

/// The columns of `box` that a triangle with corners at `p` (cells) covers somewhere in a row.
exact::CellBox rowSpan(const std::array<glm::dvec2, 3>& p, const exact::CellBox& box, int row);

} // namespace gnomon::frame
