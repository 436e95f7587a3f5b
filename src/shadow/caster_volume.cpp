#include "shadow/caster_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace gnomon::shadow {

namespace {

/// A point projected along the light, in the x and z axes of light space.
struct Seen {
    double x = 0;
    double z = 0;
};

double cross(const Seen& a, const Seen& b, const Seen& c) {
    return (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
}

/// Returns the convex hull of `points`, counter-clockwise in (x, z), without collinear points (Andrew 1979).
std::vector<Seen> convexOutline(std::vector<Seen> points) {
    std::sort(points.begin(), points.end(), [](const Seen& a, const Seen& b) {
        return a.x < b.x || (a.x == b.x && a.z < b.z);
    });
    std::vector<Seen> hull(2 * points.size());
    std::size_t count = 0;
    const auto add = [&](const Seen& point, std::size_t floor) {
        while (count >= floor && cross(hull[count - 2], hull[count - 1], point) <= 0)
            --count;
        hull[count++] = point;
    };
    for (const Seen& point : points)
        add(point, 2);
    const std::size_t lower = count + 1;
    for (std::size_t i = points.size() - 1; i-- > 0;)
        add(points[i], lower);
    hull.resize(count > 1 ? count - 1 : count);
    return hull;
}

std::vector<glm::dvec3> positionsOf(const Region& region) {
    std::vector<glm::dvec3> points;
    points.reserve(region.vertices.size());
    for (const FitVertex& vertex : region.vertices)
        points.push_back(vertex.position);
    return points;
}

std::vector<Seen> seenAlong(const LightFrame& frame, std::span<const glm::dvec3> points) {
    std::vector<Seen> seen;
    seen.reserve(points.size());
    for (const glm::dvec3& point : points)
        seen.push_back({glm::dot(frame.x, point), glm::dot(frame.z, point)});
    return seen;
}

/// One side plane of the volume that a region sweeps towards the light: the half-space normalX x + normalZ z + offset
/// >= 0 in light space.
struct SweepSide {
    double normalX = 0;
    double normalZ = 0;
    double offset = 0;
};

/// Returns the side plane through the hull edge from `a` to `b`, moved outwards until it contains all points of `all`.
/// Rounding errors in the hull therefore cut off no point.
SweepSide sideOver(const Seen& a, const Seen& b, const std::vector<Seen>& all) {
    const double length = std::hypot(b.x - a.x, b.z - a.z);
    SweepSide side{-(b.z - a.z) / length, (b.x - a.x) / length, 0};
    double minDistance = std::numeric_limits<double>::infinity();
    for (const Seen& point : all)
        minDistance = std::min(minDistance, side.normalX * point.x + side.normalZ * point.z);
    side.offset = -minDistance;
    return side;
}

/// The convex hull of points projected along the light, and the sides of the volume that the hull sweeps towards the
/// light.
struct Sweep {
    std::vector<Seen> outline;
    std::vector<SweepSide> sides;
};

Sweep sweepOf(std::span<const glm::dvec3> points, const LightFrame& frame) {
    const std::vector<Seen> seen = seenAlong(frame, points);
    // extent of the projected points; tolerances are relative to it, because a near square can be far smaller than its
    // depth range
    double size = 0;
    for (const Seen& point : seen)
        size = std::max(size, std::hypot(point.x - seen.front().x, point.z - seen.front().z));
    Sweep sweep{convexOutline(seen), {}};
    for (std::size_t i = 0; i < sweep.outline.size(); ++i) {
        const Seen& a = sweep.outline[i];
        const Seen& b = sweep.outline[(i + 1) % sweep.outline.size()];
        // Two vertices that differ only by rounding do not define a direction.
        if (std::hypot(b.x - a.x, b.z - a.z) > 1e-10 * size) sweep.sides.push_back(sideOver(a, b, seen));
    }
    return sweep;
}

Plane planeOf(const SweepSide& side, const LightFrame& frame) {
    const glm::dvec3 normal = frame.x * side.normalX + frame.z * side.normalZ;
    const double length = glm::length(normal);
    return {normal / length, side.offset / length};
}

/// Returns the corners of `outline`, each moved outwards by `growS` and `growT` in map coordinates. Returns nullopt if
/// a corner moves across the vanishing line of the warp. The convex hull of the result contains the moved outline (see
/// lightPlanePoint).
std::optional<std::vector<Seen>> grown(
    std::span<const Seen> outline, const WarpedMap& map, double growS, double growT) {
    std::vector<Seen> corners;
    corners.reserve(outline.size() * 4);
    for (const Seen& point : outline) {
        const MapPoint at = mapPoint(map, toCamera(map.frame, {point.x, 0, point.z}));
        for (const int corner : {0, 1, 2, 3}) {
            const double s = at.s + ((corner & 1) != 0 ? growS : -growS);
            const double t = at.t + ((corner & 2) != 0 ? growT : -growT);
            const std::optional<glm::dvec2> reached = lightPlanePoint(map, s, t);
            if (!reached) return std::nullopt;
            corners.push_back({reached->x, reached->y});
        }
    }
    return corners;
}

} // namespace

ConvexVolume casterVolume(const Region& region, const LightFrame& frame) {
    ConvexVolume volume;
    // Planes of the region that face away from the light bound the swept volume from below, so they are preserved.
    // Planes that face the light do not bound it. The sides of the hull replace all other planes.
    for (const Plane& plane : region.volume.planes)
        if (glm::dot(plane.normal, frame.y) > 1e-12) volume.planes.push_back(plane);
    for (const SweepSide& side : sweepOf(positionsOf(region), frame).sides)
        volume.planes.push_back(planeOf(side, frame));
    return volume;
}

namespace {

/// Returns the plane with normal `normal` that has all of `points` on its inner side and touches one of them. Distances
/// are computed relative to `origin`, for precision.
Plane touchingPlane(std::span<const glm::dvec3> points, const glm::dvec3& normal, const glm::dvec3& origin) {
    double minDistance = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& point : points)
        minDistance = std::min(minDistance, glm::dot(normal, point - origin));
    return {normal, -minDistance - glm::dot(normal, origin)};
}

/// Adds the plane through the three points with indices `three` to `volume`, if all points are on its inner side. Both
/// orientations of the plane are tested.
void addFace(
    std::span<const glm::dvec3> points, const std::array<std::size_t, 3>& three, double size, ConvexVolume& volume) {
    const glm::dvec3& a = points[three[0]];
    const glm::dvec3 across = glm::cross(points[three[1]] - a, points[three[2]] - a);
    const double length = glm::length(across);
    if (!(length > 0)) return;
    for (const glm::dvec3& normal : {across / length, across / -length}) {
        const Plane plane = touchingPlane(points, normal, points.back());
        const bool isKnown = std::any_of(volume.planes.begin(), volume.planes.end(), [&](const Plane& other) {
            return glm::dot(other.normal, normal) > 1 - 1e-12;
        });
        if (plane.signedDistance(a) <= 1e-9 * size && !isKnown) volume.planes.push_back(plane);
    }
}

} // namespace

ConvexVolume pointCasterVolume(std::span<const glm::dvec3> corners, const glm::dvec3& light) {
    std::vector<glm::dvec3> points(corners.begin(), corners.end());
    points.push_back(light);
    double size = 0;
    for (const glm::dvec3& point : points)
        size = std::max(size, glm::length(point - light));
    ConvexVolume volume; // there are few points, so the code tries each triple
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j)
            for (std::size_t k = j + 1; k < points.size(); ++k)
                addFace(points, {i, j, k}, size, volume);
    return volume;
}

ConvexVolume grownCasterVolume(
    std::span<const glm::dvec3> receivers, const WarpedMap& map, double growS, double growT) {
    ConvexVolume volume;
    // The far end of the depth range (depth 1) is the plane -y = (rawMin + rawRange) w.
    const double rawMax = map.rawMin + map.rawRange;
    const glm::dvec3 floorNormal = map.frame.y + map.frame.z * (rawMax * map.kappa);
    const double length = glm::length(floorNormal);
    volume.planes.push_back({floorNormal / length, rawMax * (1 - map.kappa * map.zMin) / length});
    const Sweep sweep = sweepOf(receivers, map.frame);
    const std::optional<std::vector<Seen>> corners = grown(sweep.outline, map, growS, growT);
    if (!corners) return volume;
    for (SweepSide side : sweep.sides) {
        for (const Seen& corner : *corners)
            side.offset = std::max(side.offset, -(side.normalX * corner.x + side.normalZ * corner.z));
        volume.planes.push_back(planeOf(side, map.frame));
    }
    return volume;
}

} // namespace gnomon::shadow
