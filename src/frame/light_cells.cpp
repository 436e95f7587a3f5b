#include "frame/light_cells.h"

#include "exact/sample_grid.h"
#include "plan/cell_maps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::frame {

namespace {

/// The cells that a polygon on the light plane reaches: the part of it that has w enough to cover a point.
struct Reach {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p) {
        low = glm::min(low, glm::dvec2(p) / p.z);
        high = glm::max(high, glm::dvec2(p) / p.z);
    }

    exact::CellBox cells() const {
        if (!(high.x >= 0 && high.y >= 0 && low.x <= plan::kCellSide && low.y <= plan::kCellSide)) return {};
        const auto cell = [](double x) { return exact::cellAt(x, plan::kCellSide); };
        return {cell(low.x), cell(low.y), cell(high.x), cell(high.y)};
    }
};

template <std::size_t Count>
exact::CellBox cellsOfPolygon(const std::array<glm::dvec3, Count>& polygon, double leastW) {
    Reach reach;
    for (std::size_t i = 0; i < Count; ++i) {
        const glm::dvec3& p = polygon[i];
        const glm::dvec3& q = polygon[(i + 1) % Count];
        if (p.z >= leastW) reach.add(p);
        if ((p.z >= leastW) == (q.z >= leastW)) continue;
        const double share = (leastW - p.z) / (q.z - p.z);
        reach.add({glm::dvec2(p) + share * (glm::dvec2(q) - glm::dvec2(p)), leastW});
    }
    return reach.cells();
}

} // namespace

glm::dvec3 fromOrigin(const hierarchy::GridPoint& p, const hierarchy::GridPoint& origin) {
    const auto difference = [](std::uint32_t a, std::uint32_t b) {
        return static_cast<double>(static_cast<std::int32_t>(a - b));
    };
    return {difference(p.x, origin.x), difference(p.y, origin.y), difference(p.z, origin.z)};
}

glm::dvec3 sheared(const exact::LightShear& shear, const glm::dvec3& p) {
    const double along = p[shear.along];
    return {p[shear.first] - shear.firstRatio * along, p[shear.second] - shear.secondRatio * along, shear.sign * along};
}

exact::CellBox cellsOf(const std::array<glm::dvec3, 3>& places, double leastW) {
    return cellsOfPolygon(places, leastW);
}

double coveredArea(const std::array<glm::dvec3, 3>& places, double leastW, const exact::CellBox& box) {
    const double most = (box.x1 - box.x0 + 1.0) * (box.y1 - box.y0 + 1.0);
    for (const glm::dvec3& p : places)
        if (p.z < leastW) return most;
    const auto place = [&](std::size_t k) { return glm::dvec2(places[k]) / places[k].z; };
    const glm::dvec2 a = place(1) - place(0);
    const glm::dvec2 b = place(2) - place(0);
    return std::min(most, 0.5 * std::abs(a.x * b.y - a.y * b.x));
}

LightBox lightBox(
    const exact::LightShear& shear,
    const glm::dmat3& cells,
    double leastW,
    const glm::dvec3& least,
    const glm::dvec3& most) {
    const auto span = [&](int axis, double ratio) {
        const double p = ratio * least[shear.along];
        const double q = ratio * most[shear.along];
        return glm::dvec2(least[axis] - std::max(p, q), most[axis] - std::min(p, q));
    };
    const glm::dvec2 u = span(shear.first, shear.firstRatio);
    const glm::dvec2 v = span(shear.second, shear.secondRatio);
    const std::array<glm::dvec3, 4> corners{
        cells * glm::dvec3(u[0], v[0], 1),
        cells * glm::dvec3(u[1], v[0], 1),
        cells * glm::dvec3(u[1], v[1], 1),
        cells * glm::dvec3(u[0], v[1], 1)};
    return {
        cellsOfPolygon(corners, leastW), static_cast<float>(shear.sign > 0 ? most[shear.along] : -least[shear.along])};
}

exact::CellBox rowSpan(const std::array<glm::dvec2, 3>& p, const exact::CellBox& box, int row) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (std::size_t k = 0; k < 3; ++k) {
        glm::dvec2 a = p[k];
        glm::dvec2 b = p[(k + 1) % 3];
        if (a.y > b.y) std::swap(a, b);
        if (b.y < row || a.y > row + 1) continue;
        const double slope = b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0;
        for (const double y : {std::max(a.y, double(row)), std::min(b.y, row + 1.0)}) {
            least = std::min(least, a.x + (y - a.y) * slope);
            most = std::max(most, a.x + (y - a.y) * slope);
        }
    }
    if (!(least <= most)) return {};
    return {
        std::max(box.x0, exact::cellAt(least, plan::kCellSide)),
        row,
        std::min(box.x1, exact::cellAt(most, plan::kCellSide)),
        row};
}

} // namespace gnomon::frame
