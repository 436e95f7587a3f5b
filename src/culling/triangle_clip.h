// A triangle cut by planes: the part of it that a convex volume holds.
#pragma once

#include "core/convex_volume.h"

#include <array>
#include <vector>

namespace gnomon::culling {

/// Clips triangles against one volume; keeps its buffers between calls.
class TriangleClipper {
public:
    explicit TriangleClipper(const ConvexVolume& volume) : volume_(&volume) {}

    /// The corners of the part of the triangle inside the volume (Sutherland, Hodgman 1974), empty if there is none.
    /// Valid until the next call.
    const std::vector<glm::dvec3>& clipped(const std::array<glm::dvec3, 3>& corners);

private:
    const ConvexVolume* volume_;
    std::vector<glm::dvec3> polygon_;
    std::vector<glm::dvec3> next_;
    std::vector<double> distances_;
};

} // namespace gnomon::culling
