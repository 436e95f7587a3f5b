#include "raster/clip.h"

#include <algorithm>
#include <cmath>

namespace gnomon::raster {
namespace {

struct Corner {
    double x = 0;
    double y = 0;
    double z = 0;
    double w = 0;
    bool isCut = false; // true: clipping created this corner
};

struct Polygon {
    std::array<Corner, 32> corners{};
    std::size_t count = 0;
};

/// Returns the signed distance of point `p` to a clipping plane, at least 0 if the point is inside. Planes 0 to 3 are
/// the sides of the guard band, 4 is near and 5 is far.
double distance(const Projection& projection, int plane, const Corner& p) {
    switch (plane) {
    case 0:
        return double{projection.guardX} * p.w + p.x;
    case 1:
        return double{projection.guardX} * p.w - p.x;
    case 2:
        return double{projection.guardY} * p.w + p.y;
    case 3:
        return double{projection.guardY} * p.w - p.y;
    case 4:
        return p.w - p.z;
    default:
        return p.z;
    }
}

/// Returns the intersection of a triangle edge with a clipping plane. The computation always starts at the inside
/// corner, so both triangles of an edge compute the same point.
Corner cut(const Corner& inside, double insideDistance, const Corner& outside, double outsideDistance) {
    const double t = insideDistance / (insideDistance - outsideDistance);
    return {
        inside.x + (outside.x - inside.x) * t,
        inside.y + (outside.y - inside.y) * t,
        inside.z + (outside.z - inside.z) * t,
        inside.w + (outside.w - inside.w) * t,
        true};
}

Polygon cutByPlane(const Projection& projection, int plane, const Polygon& polygon) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Corner& a = polygon.corners[i];
        const Corner& b = polygon.corners[(i + 1) % polygon.count];
        const double da = distance(projection, plane, a);
        const double db = distance(projection, plane, b);
        if (da >= 0) kept.corners[kept.count++] = a;
        if (da >= 0 && db < 0) kept.corners[kept.count++] = cut(a, da, b, db);
        if (da < 0 && db >= 0) kept.corners[kept.count++] = cut(b, db, a, da);
    }
    return kept;
}

SnappedVertex snappedCut(const Projection& projection, const Corner& p) {
    // Rounding can move a corner slightly outside the guard band after clipping.
    constexpr double kLimit = 2.0 * kGuardPixels;
    const double x = p.x / p.w * projection.scaleX + projection.translateX - 0.5;
    const double y = p.y / p.w * projection.scaleY + projection.translateY - 0.5;
    const double z = std::clamp(p.z / p.w, -double{kDepthLimit}, double{kDepthLimit});
    if (projection.rows != nullptr) {
        const double yOverW = std::clamp(p.y / p.w, -double{projection.guardY}, double{projection.guardY});
        return unevenTo(
            std::clamp(x, -kLimit, kLimit) * kSubpixels, static_cast<float>(yOverW), static_cast<float>(z) + 0.0F);
    }
    return snappedTo(
        std::clamp(x, -kLimit, kLimit) * kSubpixels,
        std::clamp(y, -kLimit, kLimit) * kSubpixels,
        static_cast<float>(z) + 0.0F);
}

} // namespace

ClippedPolygon clipTriangle(const Projection& projection, const std::array<ClipPosition, 3>& triangle) {
    Polygon polygon;
    for (const ClipPosition& p : triangle)
        polygon.corners[polygon.count++] = {p.x, p.y, p.z, p.w, false};
    const int planeCount = projection.cutsDepth ? 6 : 4;
    for (int plane = 0; plane < planeCount && polygon.count > 0; ++plane)
        polygon = cutByPlane(projection, plane, polygon);

    ClippedPolygon clipped;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Corner& p = polygon.corners[i];
        // A point with w = 0 that is inside all planes is the centre of projection, so the triangle is seen edge-on.
        // Non-finite coordinates come from overflow.
        if (!(p.w >= double{kMinW}) || !std::isfinite(p.x + p.y + p.z + p.w)) return {};
        clipped.corners[clipped.count++] = p.isCut ? snappedCut(projection, p)
                                                   : snapped(
                                                         projection,
                                                         {static_cast<float>(p.x),
                                                          static_cast<float>(p.y),
                                                          static_cast<float>(p.z),
                                                          static_cast<float>(p.w)});
    }
    return clipped;
}

} // namespace gnomon::raster
