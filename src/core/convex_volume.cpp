#include "core/convex_volume.h"

namespace gnomon {

bool contains(const ConvexVolume& volume, const glm::dvec3& point) {
    return std::all_of(volume.planes.begin(), volume.planes.end(), [&](const Plane& plane) {
        return plane.signedDistance(point) >= 0;
    });
}

Containment classify(const ConvexVolume& volume, const Box& box) {
    const glm::dvec3 center = box.center();
    const glm::dvec3 half = (box.max - box.min) * 0.5;
    Containment result = Containment::Inside;
    for (const Plane& plane : volume.planes) {
        const double reach = glm::dot(glm::abs(plane.normal), half);
        const double middle = plane.signedDistance(center);
        if (middle < -reach) return Containment::Outside;
        if (middle < reach) result = Containment::Intersecting;
    }
    return result;
}

} // namespace gnomon
