// Light directions for which the figures of the shadow theory are computed.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace gnomon::theory {

constexpr double kDegree = 0.017453292519943295; // radians

/// Returns light directions on a square grid over the disc that represents the hemisphere above the viewer, seen from
/// above.
std::vector<glm::dvec3> hemisphereGrid();

/// Returns `count` light directions, spread evenly over the hemisphere above the viewer.
std::vector<glm::dvec3> evenHemisphere(int count);

} // namespace gnomon::theory
