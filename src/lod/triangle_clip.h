// Clips a triangle to a convex volume.
#pragma once

#include "core/convex_volume.h"

#include <array>
#include <vector>

namespace gnomon::lod {

/// Clips triangles to one convex volume, and reuses its buffers.
class TriangleClipper {
public:
    explicit TriangleClipper(const ConvexVolume& volume) : volume_(&volume) {}

    /// Returns the corners of the part of the triangle inside the volume (Sutherland, Hodgman 1974). The list is empty
    /// if no part is inside. The result is valid until the next call.
    const std::vector<glm::dvec3>& clipped(const std::array<glm::dvec3, 3>& corners);

private:
    const ConvexVolume* volume_;
    std::vector<glm::dvec3> polygon_;
    std::vector<glm::dvec3> next_;
    std::vector<double> distances_;
};

} // namespace gnomon::lod
