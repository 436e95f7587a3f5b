// A convex volume as the intersection of half-spaces, and the conservative test of a box against it.
#pragma once

#include "core/box.h"

#include <vector>

namespace gnomon {

/// The half-space of points p with dot(normal, p) + offset >= 0. `normal` has unit length and points inward.
struct Plane {
    glm::dvec3 normal{0, 0, 1};
    double offset = 0;

    double signedDistance(const glm::dvec3& point) const { return glm::dot(normal, point) + offset; }
};

/// The points inside every plane; no planes is all of space.
struct ConvexVolume {
    std::vector<Plane> planes;
};

/// How a box lies to a volume.
enum class Containment { Outside, Intersecting, Inside };

bool contains(const ConvexVolume& volume, const glm::dvec3& point);

/// Conservative: a box that touches the volume is never `Outside`; some that do not are `Intersecting`.
Containment classify(const ConvexVolume& volume, const Box& box);

} // namespace gnomon
