#include "preprocess/exporter/tiles/clip.h"

#include <algorithm>

namespace gnomon::exporter {

namespace {

/// Returns the point of the edge between `a` and `b` where the coordinate `axis` is equal to `plane`. The computation
/// starts at the lexicographically lower end, so that both triangles at this edge get the same point.
ClippedCorner crossing(ClippedCorner a, ClippedCorner b, std::size_t axis, double plane) {
    if (b.place < a.place) std::swap(a, b);
    const double part = (plane - a.place[axis]) / (b.place[axis] - a.place[axis]);
    const auto mix = [part](auto& to, const auto& from, const auto& until) {
        for (std::size_t i = 0; i < to.size(); ++i)
            to[i] = from[i] + part * (until[i] - from[i]);
    };
    ClippedCorner corner;
    mix(corner.place, a.place, b.place);
    mix(corner.normal, a.normal, b.normal);
    mix(corner.color, a.color, b.color);
    corner.place[axis] = plane;
    return corner;
}

/// Returns the part of a polygon on one side of the plane where the coordinate `axis` is equal to `plane`: the part
/// above the plane, or the part below it if `sign` is -1.
std::vector<ClippedCorner> cutOff(
    const std::vector<ClippedCorner>& polygon, std::size_t axis, double plane, double sign) {
    std::vector<ClippedCorner> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const ClippedCorner& from = polygon[i];
        const ClippedCorner& to = polygon[(i + 1) % polygon.size()];
        const double before = sign * (from.place[axis] - plane);
        const double after = sign * (to.place[axis] - plane);
        if (before >= 0) kept.push_back(from);
        if ((before > 0 && after < 0) || (before < 0 && after > 0)) kept.push_back(crossing(from, to, axis, plane));
    }
    return kept;
}

} // namespace

std::vector<ClippedCorner> clipped(std::span<const ClippedCorner> triangle, const TileCell& cell) {
    std::vector<ClippedCorner> polygon(triangle.begin(), triangle.end());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto low = static_cast<double>(cell.low[axis]);
        const auto high = static_cast<double>(cell.low[axis] + cell.side);
        const auto isOn = [&](double plane) {
            return std::all_of(
                polygon.begin(), polygon.end(), [&](const ClippedCorner& c) { return c.place[axis] == plane; });
        };
        if (isOn(high)) return {};
        polygon = cutOff(cutOff(polygon, axis, low, 1), axis, high, -1);
        if (polygon.size() < 3) return {};
    }
    return polygon;
}

bool liesOnSide(const ClippedCorner& a, const ClippedCorner& b, const TileCell& cell) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const std::uint64_t plane : {cell.low[axis], cell.low[axis] + cell.side}) {
            const auto at = static_cast<double>(plane);
            if (a.place[axis] == at && b.place[axis] == at) return true;
        }
    return false;
}

} // namespace gnomon::exporter
