#include "core/convex_volume.h"

namespace gnomon {

bool contains(const ConvexVolume& volume, const glm::dvec3& point) {
    return std::all_of(volume.planes.begin(), volume.planes.end(), [&](const Plane& plane) {
        return plane.signedDistance(point) >= 0;
    });
}

Containment classify(const ConvexVolume& volume, const Box& box) {
    const BoxAgainstPlanes against(box);
    Containment result = Containment::Inside;
    for (const Plane& plane : volume.planes) {
        const Containment one = against.classify(plane.normal, plane.offset);
        if (one == Containment::Outside) return one;
        if (one == Containment::Intersecting) result = one;
    }
    return result;
}

} // namespace gnomon
